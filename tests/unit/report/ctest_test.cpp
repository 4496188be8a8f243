// Tests the output for CTest: the list of tests, and the results of their checks.

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/private_folder.hpp"
#include "core/temporary_folder.hpp"
#include "findings.hpp"
#include "report/ci/ctest_list.hpp"
#include "report/ci/ctest_output.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Verdict;
using testing::HasSubstr;
using testing::Not;

TEST(CTestList, TestNamesAreValidFileNames) {
  EXPECT_EQ(ctest_stem("volume", "volume/quick"), "volume.quick");
  EXPECT_EQ(ctest_stem("volume", "my plan;1"), "volume.my_plan_1");
}

TEST(CTestList, AScoreWaitsForEveryDevice) {
  record::Device a{.id = "gl:a", .api = "gl"};
  record::Device b{.id = "gl:b", .api = "gl"};
  const std::vector<PlanTests> plans{{.suite = "volume",
                                      .plan = "volume/stress",
                                      .stem = "volume.stress",
                                      .store = "/s p;a/volume.stress.sqlite",
                                      .checks = {Check::counters, Check::stress}}};
  const std::string list = ctest_list("/bin/triptych", plans, std::vector{a, b});
  EXPECT_THAT(list, HasSubstr("add_test([=[volume.stress.measure.gl:a]=] [=[/bin/triptych]=] "
                              "[=[test-measure]=] [=[volume/stress]=] [=[--device]=] [=[gl:a]=] "
                              "[=[--store]=] [=[/s p;a/volume.stress.sqlite]=])"));
  const auto needs = [&](const std::string& test) {
    const std::size_t at = list.find("set_tests_properties([=[" + test + "]=]");
    const std::size_t begin = list.find("FIXTURES_REQUIRED", at);
    return list.substr(begin, list.find('\n', begin) - begin);
  };
  EXPECT_THAT(needs("volume.stress.stress.gl:a"),
              HasSubstr("[=[volume.stress.gl:a;volume.stress.gl:b]=]"));
  EXPECT_THAT(needs("volume.stress.counters.gl:a"), HasSubstr("[=[volume.stress.gl:a]=]"));
  EXPECT_THAT(list, Not(HasSubstr("agreement")));
}

TEST(CTestList, OneDevicePerDriverMeasuresALargePlan) {
  const record::Device egl{.id = "gl:a-egl", .api = "gl", .driver = "a", .driver_version = "1"};
  const record::Device osmesa{.id = "gl:a-os", .api = "gl", .driver = "a", .driver_version = "1"};
  const record::Device newer{.id = "gl:a-2", .api = "gl", .driver = "a", .driver_version = "2"};
  const record::Device vulkan{
      .id = "vulkan:a", .api = "vulkan", .driver = "a", .driver_version = "1"};
  const std::vector devices{egl, osmesa, newer, vulkan};
  PlanTests plan{.suite = "volume",
                 .plan = "volume/cost",
                 .stem = "volume.cost",
                 .store = "s",
                 .checks = {Check::cost}};
  const auto measures = [&](const record::Device& device) {
    const std::string list = ctest_list("triptych", std::vector{plan}, devices);
    return list.find("volume.cost.measure." + device.id) != std::string::npos;
  };
  EXPECT_TRUE(measures(osmesa));
  plan.one_per_driver = true;
  EXPECT_FALSE(measures(osmesa));
  EXPECT_TRUE(measures(egl) && measures(newer) && measures(vulkan));
}

class CTestOutput : public testing::Test {
 protected:
  core::TemporaryFolder folder_;
  record::Store store_{folder_.path() / "s", record::Store::Mode::append};
  judge::GateResult result_{.plan = "volume/quick", .run = "r", .findings = {}};
  void add(Verdict verdict, const std::string& configuration, Check check = Check::counters) {
    result_.findings.push_back(
        finding_of(check, verdict, "gl:a", configuration, {.cause = judge::Cause::untimed}));
    result_.findings.back().numbers = {{"ratio", 0.5}};
  }
};

TEST_F(CTestOutput, AdviceAloneDoesNotPass) {
  add(Verdict::advisory, "step=1");
  EXPECT_TRUE(skip_reason(result_));
  add(Verdict::pass, "step=2");
  EXPECT_EQ(skip_reason(result_), std::nullopt);
}

TEST_F(CTestOutput, ADeviceThatCannotBeJudgedIsNotSkipped) {
  add(Verdict::skipped, "step=1");
  add(Verdict::pass, "");
  EXPECT_TRUE(skip_reason(result_));
  add(Verdict::cannot_judge, "");
  EXPECT_EQ(skip_reason(result_), std::nullopt);
}

TEST_F(CTestOutput, ACorrelationOfADeviceIsAVerdict) {
  add(Verdict::advisory, "");
  add(Verdict::pass, "", Check::correlation);
  EXPECT_EQ(skip_reason(result_), std::nullopt);
}

// Sets TMPDIR until the end of the scope.
class TemporaryFolders {
 public:
  explicit TemporaryFolders(const std::filesystem::path& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  TemporaryFolders(const TemporaryFolders&) = delete;
  TemporaryFolders& operator=(const TemporaryFolders&) = delete;
  ~TemporaryFolders() { before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR"); }

 private:
  std::optional<std::string> before_;
};

// Another user may have created the folder for images before, as a link to a folder of this user.
// Names come from a store, so they may name another folder.
TEST_F(CTestOutput, ImagesAreWrittenOnlyToAPrivateFolder) {
  const auto tmp = folder_.path() / "tmp";
  std::filesystem::create_directories(tmp);
  // With some values of umask, other users could write to the folder.
  std::filesystem::permissions(tmp, std::filesystem::perms::owner_all);
  const TemporaryFolders folders(tmp);
  store_.add_run({.id = "r", .plan = "volume/quick", .started_at = "", .system = {}});
  store_.add_image("hash", core::encode_exr(core::Image(2, 2)));
  record::Record record{.run = "r", .plan = "volume/quick", .configuration = "step=1"};
  record.device = "gl:a";
  record.image = "hash";
  store_.add_record(record);
  add(Verdict::regression, "step=1");
  result_.findings.front().test = "../../x";
  const auto truth = [](const record::Record&) {
    return judge::TruthPair{core::Image(2, 2), core::Image(2, 2)};
  };
  const auto own = tmp / core::name_of_this_user();
  EXPECT_THAT(ctest_output(result_, store_, truth),
              HasSubstr((own / "ctest/.._.._x.test.png").string()));
  EXPECT_TRUE(std::filesystem::exists(own / "ctest/.._.._x.difference.png"));
  EXPECT_EQ(std::filesystem::status(own / "ctest").permissions(),
            std::filesystem::perms::owner_all);
  std::filesystem::remove_all(own);
  std::filesystem::create_directory_symlink(folder_.path(), own);
  EXPECT_THROW(static_cast<void>(ctest_output(result_, store_, truth)), core::IoError);
}

TEST_F(CTestOutput, ReportsFailuresAndTheWorstNumbers) {
  add(Verdict::regression, "step=1");
  add(Verdict::pass, "step=2");
  const std::string text = ctest_output(result_, store_, {});
  EXPECT_THAT(text, HasSubstr("regression step=1: "));
  EXPECT_THAT(text, HasSubstr("name=\"ratio\">0.5</CTestMeasurement>\n"));
  EXPECT_THAT(text, Not(HasSubstr("step=2")));
  EXPECT_THAT(text, HasSubstr("\nFAIL: 1 regression"));
}

}  // namespace
}  // namespace triptych::report
