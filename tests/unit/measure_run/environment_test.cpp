#include "measure/system/environment.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/private_folder.hpp"
#include "measure/worker/worker_setup.hpp"
#include "tests/unit/measure_run/scratch.hpp"

namespace triptych::measure {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ParseEnvironment, AValueMayHoldCommas) {
  using testing::ElementsAre;
  EXPECT_THAT(parse_environment("A=1", "--a"), ElementsAre("A=1"));
  EXPECT_THAT(parse_environment("A=1,2,B_3=,C=x=y,z", "--a"),
              ElementsAre("A=1,2", "B_3=", "C=x=y,z"));
  for (const char* text : {"", "A", "1=2", ",A=1"}) {
    EXPECT_THROW(static_cast<void>(parse_environment(text, "--a")), core::InputError) << text;
  }
}

TEST(DriverVariables, DifferOnlyIfTheirValuesDiffer) {
  const Variable inherited("VK_DRIVER_FILES", "/a.json");
  const Variable library("LD_LIBRARY_PATH");
  const auto differing = [](std::vector<std::string> a, std::vector<std::string> b) {
    return differing_driver_variables(a, b);
  };
  EXPECT_THAT(differing({"VK_DRIVER_FILES=/a.json"}, {}), testing::IsEmpty());
  EXPECT_THAT(differing({"LP_NATIVE_VECTOR_WIDTH=128"}, {}), testing::IsEmpty());
  EXPECT_THAT(differing({}, {"VK_DRIVER_FILES=/b.json", "LD_LIBRARY_PATH=/b"}),
              testing::ElementsAre("LD_LIBRARY_PATH", "VK_DRIVER_FILES"));
}

TEST(WorkerEnvironment, SetsDefaultsForPoclOnly) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  const Variable unset("POCL_CACHE_DIR");
  const Variable unset_too("POCL_PTHREAD_MIN_WGS");
  const CacheFolder cache("opencl:pocl");
  const auto opencl = worker_environment("opencl:pocl", cache);
  EXPECT_THAT(opencl, Contains("POCL_CACHE_DIR=" + cache.path().string()));
  EXPECT_THAT(opencl, Contains("POCL_PTHREAD_MIN_WGS=1"));
  EXPECT_THAT(worker_environment("vulkan:lavapipe", cache), Each(Not(StartsWith("POCL_"))));
}

TEST(WorkerEnvironment, KeepsVariablesThatTheUserSet) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  const Variable set("POCL_PTHREAD_MIN_WGS", "8");
  const CacheFolder cache("opencl:pocl");
  const auto environment = worker_environment("opencl:pocl", cache);
  EXPECT_THAT(environment, Contains("POCL_PTHREAD_MIN_WGS=8"));
  EXPECT_THAT(environment, Not(Contains("POCL_PTHREAD_MIN_WGS=1")));
}

TEST(WorkerEnvironment, OverridesWinOverTheUserAndTheDefaults) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  const Variable set("LP_NUM_THREADS", "2");
  const CacheFolder cache("opencl:pocl");
  const std::vector<std::string> overrides{"LP_NUM_THREADS=1", "POCL_PTHREAD_MIN_WGS=4"};
  const auto environment = worker_environment("opencl:pocl", cache, overrides);
  EXPECT_THAT(environment, Contains("LP_NUM_THREADS=1"));
  EXPECT_THAT(environment, Not(Contains("LP_NUM_THREADS=2")));
  EXPECT_THAT(environment, Contains("POCL_PTHREAD_MIN_WGS=4"));
  EXPECT_THAT(environment, Not(Contains("POCL_PTHREAD_MIN_WGS=1")));
}

TEST(WorkerEnvironment, RemovesFlagsOfGoogleBenchmark) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  const Variable flag("BENCHMARK_LIST_TESTS", "true");
  const CacheFolder cache("null:scripted");
  EXPECT_THAT(worker_environment("null:scripted", cache), Each(Not(StartsWith("BENCHMARK_"))));
}

// The file `environment` of ci/drivers/fetch names the manifest of lavapipe. The worker of a device
// that only compiles must load the driver of that device from the same folder instead.
TEST(WorkerSetup, ACompilerReplacesTheDriverInTheSameFolder) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  const std::string library = (scratch.path() / "libradv.so").string();
  const std::string radv = (scratch.path() / "radeon_icd.json").string();
  const std::string lavapipe = (scratch.path() / "lvp_icd.json").string();
  core::write_file("RADV_FORCE_FAMILY", library);
  core::write_file(fmt::format(R"({{"ICD": {{"library_path": "{}"}}}})", library), radv);
  core::write_file("{}", lavapipe);
  const SideOptions side{.device = "vulkan:radv-navi31",
                         .command = {"worker"},
                         .environment = {"VK_DRIVER_FILES=" + lavapipe}};
  const CacheFolder cache(cache_name(side, false));
  const auto environment = worker_setup(side, false, cache, std::chrono::seconds(1)).environment;
  EXPECT_THAT(environment, Contains("VK_DRIVER_FILES=" + radv));
  EXPECT_THAT(environment, Not(Contains("VK_DRIVER_FILES=" + lavapipe)));
}

TEST(CacheFolder, IsLockedByOneProcessAndReused) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", scratch.path().string());
  std::filesystem::path first_path;
  {
    const CacheFolder first("opencl:pocl");
    const CacheFolder second("opencl:pocl");
    first_path = first.path();
    EXPECT_TRUE(std::filesystem::is_directory(first.path()));
    EXPECT_NE(first.path(), second.path());
  }
  EXPECT_EQ(CacheFolder("opencl:pocl").path(), first_path);
}

TEST(CacheFolder, FallsBackToTheNextPlaceThatCanBeWritten) {
  const ScratchFolder scratch;
  const Variable cache_home("XDG_CACHE_HOME", "/proc/nowhere");
  const Variable home("HOME", "/proc/nowhere");
  const Variable temporary("TMPDIR", scratch.path().string());
  EXPECT_THAT(CacheFolder("opencl:pocl").path().string(), StartsWith(scratch.path().string()));
}

// Someone else has planted a folder with the expected name, and with compiled code in it, in a
// place that everyone can write to.
class PlantedCache : public testing::Test {
 protected:
  // The folder for temporary files is the only place left for a cache.
  const ScratchFolder scratch_;
  const Variable cache_home_{"XDG_CACHE_HOME", "/proc/nowhere"};
  const Variable home_{"HOME", "/proc/nowhere"};
  const Variable temporary_{"TMPDIR", scratch_.path().string()};
  const std::filesystem::path planted_ = scratch_.path() / core::name_of_this_user();

  static std::string refusal() {
    try {
      return "used: " + CacheFolder("opencl:pocl").path().string();
    } catch (const core::IoError& error) {
      return error.what();
    }
  }
};

TEST_F(PlantedCache, IsCreatedForThisUserOnly) {
  const mode_t before = ::umask(0);
  const CacheFolder cache("opencl:pocl");
  ::umask(before);
  for (const auto& folder : {cache.path(), cache.path().parent_path()}) {
    EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all)
        << folder;
  }
}

TEST_F(PlantedCache, ASymbolicLinkIsRejected) {
  const ScratchFolder other;
  std::filesystem::create_directory_symlink(other.path(), planted_);
  EXPECT_THAT(refusal(), testing::HasSubstr("is a symbolic link"));
  std::filesystem::remove(planted_);
  std::filesystem::create_directory(planted_);
  std::filesystem::permissions(planted_, std::filesystem::perms::owner_all);
  std::filesystem::create_directory_symlink(other.path(), planted_ / "opencl-pocl-0");
  EXPECT_THAT(refusal(), testing::HasSubstr("is a symbolic link"));
}

TEST_F(PlantedCache, AFolderThatOthersCanWriteIsRejected) {
  std::filesystem::create_directory(planted_);
  ASSERT_EQ(::chmod(planted_.c_str(), 0777), 0);
  EXPECT_THAT(refusal(), testing::HasSubstr("is writable by other users"));
}

TEST_F(PlantedCache, AFolderThatOthersCanReadIsMadePrivate) {
  std::filesystem::create_directory(planted_);
  ASSERT_EQ(::chmod(planted_.c_str(), 0755), 0);
  EXPECT_THAT(refusal(), StartsWith("used: "));
  EXPECT_EQ(std::filesystem::status(planted_).permissions(), std::filesystem::perms::owner_all);
}

TEST_F(PlantedCache, AFolderOfAnotherUserIsRejected) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  std::filesystem::create_directory(planted_);
  ASSERT_EQ(::chmod(planted_.c_str(), 0755), 0);
  ASSERT_EQ(::chown(planted_.c_str(), 65534, 65534), 0);
  EXPECT_THAT(refusal(), testing::HasSubstr("belongs to another user"));
}

TEST_F(PlantedCache, AParentInWhichOthersCanRenameIsRejected) {
  ASSERT_EQ(::chmod(scratch_.path().c_str(), 0777), 0);
  EXPECT_THAT(refusal(), testing::HasSubstr("sticky bit is not set"));
  ASSERT_EQ(::chmod(scratch_.path().c_str(), 01777), 0);
  EXPECT_THAT(refusal(), StartsWith("used: "));
}

TEST(ForbidsMeasuring, NamesLpPerf) {
  const Variable unset("LP_PERF");
  EXPECT_EQ(reason_not_to_measure(), std::nullopt);
  const Variable set("LP_PERF", "no_rast");
  EXPECT_THAT(reason_not_to_measure().value(), testing::HasSubstr("LP_PERF=no_rast"));
}

}  // namespace
}  // namespace triptych::measure
