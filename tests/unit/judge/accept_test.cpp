#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_file.hpp"
#include "fixture.hpp"

namespace triptych::judge {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class AcceptTest : public JudgeTest {
 protected:
  [[nodiscard]] core::Json read(const std::filesystem::path& file) const {
    return core::Json::parse(std::ifstream(file));
  }
  [[nodiscard]] std::string text_of(const std::filesystem::path& file) const {
    std::ostringstream out;
    out << std::ifstream(file).rdbuf();
    return out.str();
  }
};

TEST_F(AcceptTest, WritesEveryKindOfBaseline) {
  add_run("a");
  const auto lines = accept_run("a");
  EXPECT_THAT(lines, Contains(HasSubstr("counters.json: 0 changed, 24 added, 0 removed")));
  EXPECT_EQ(read(baseline("counters.json"))[plain_]["samples"]["opencl:pocl"], 1000000);
  EXPECT_EQ(read(baseline("images.json")).size(), 2U);
  const core::Json timing = read(device_file("timings", "opencl"))["configurations"][plain_];
  EXPECT_EQ(timing["clock"], "wall");
  EXPECT_EQ(timing["frames"], 5);
  EXPECT_GE(timing["spread"], 0.005);
  const core::Json manifest = read(baseline("manifest.json"));
  EXPECT_EQ(manifest["configurations"], 4);
  EXPECT_EQ(manifest["devices"].size(), 3U);
  EXPECT_TRUE(manifest["files"].contains("counters.json"));
  EXPECT_EQ(
      read(device_file("statistics", "vulkan"))["configurations"][bricks_]["fragment_invocations"],
      64);
  const core::Json history = read(baseline("history.json"));
  ASSERT_EQ(history.size(), 1U);
  EXPECT_EQ(history[0]["reason"], "a test");
  EXPECT_EQ(history[0]["devices"].size(), 3U);
}

TEST_F(AcceptTest, OneCounterPerLine) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_THAT(text_of(baseline("counters.json")),
              HasSubstr("\n  \"samples\": {\"gl:llvmpipe-egl\":1000000,\"opencl:pocl\":1000000,"
                        "\"vulkan:lavapipe\":1000000}\n"));
}

TEST_F(AcceptTest, ChangesAreListedOldToNew) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "opencl:pocl" && record.configuration == plain_) {
      record.counters["samples"] = 7;
    }
  });
  EXPECT_THAT(accept_run("b"), Contains("  " + plain_ + "/samples/opencl:pocl: 1000000 → 7"));
}

TEST_F(AcceptTest, AcceptingTheSameRunAgainChangesNothing) {
  add_run("a");
  (void)accept_run("a");
  EXPECT_THAT(accept_run("a"), IsEmpty());
}

TEST_F(AcceptTest, OnlySelectedValuesAreReplaced) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) { record.counters["samples"] = 7; });
  (void)accept_run("b", {.only = "*skip=bricks*"});
  const core::Json counters = read(baseline("counters.json"));
  EXPECT_EQ(counters[bricks_]["samples"]["opencl:pocl"], 7);
  EXPECT_EQ(counters[plain_]["samples"]["opencl:pocl"], 1000000);
}

TEST_F(AcceptTest, ConfigurationsRemovedFromThePlanAreDropped) {
  add_run("a");
  (void)accept_run("a");
  store_.add_run({"b", plan, "2026-02-02T00:00:00Z", {}});
  for (record::Record record : store_.records("a")) {
    record.run = "b";
    if (record.scene == front_) store_.add_record(record);
  }
  for (const auto& entry : store_.devices("a")) store_.add_device("b", entry.device, {});
  EXPECT_THROW((void)accept_run("b"), core::InputError);
  EXPECT_EQ(read(baseline("counters.json")).size(), 4U);
  EXPECT_THAT(accept_run("b", {.drop = true}), Contains(testing::EndsWith(".exr: removed")));
  EXPECT_EQ(read(baseline("counters.json")).size(), 2U);
  EXPECT_EQ(read(baseline("images.json")).size(), 1U);
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(baseline("images"))), 1);
}

// Values of configurations that are skipped now are dropped only on request, because a skip may be
// temporary.
TEST_F(AcceptTest, SkippedConfigurationsAreDroppedOnRequest) {
  accept_first([](record::Record& record, core::Image&) { record.memory = {{"buffers", 9}}; });
  const auto timings = device_file("timings", "opencl");
  add_run("b", [&](record::Record& record, core::Image&) {
    const bool skips = record.device == "opencl:pocl" && record.configuration == plain_;
    if (skips) record.outcome = record::Outcome::skipped;
  });
  const auto stored = [&](const char* file) {
    return read(baseline(file))[plain_].dump().find("opencl:pocl") != std::string::npos;
  };
  (void)accept_run("b");
  EXPECT_TRUE(stored("counters.json") && stored("memory.json"));
  (void)accept_run("b", {.only = bricks_, .drop = true});
  EXPECT_TRUE(stored("counters.json") && stored("memory.json"));
  (void)accept_run("b", {.only = plain_, .drop = true});
  EXPECT_FALSE(stored("counters.json") || stored("memory.json"));
  EXPECT_EQ(read(timings)["configurations"].count(plain_), 0U);
  EXPECT_EQ(read(timings)["configurations"].count(bricks_), 1U);
  core::Json counters = read(baseline("counters.json"));
  EXPECT_EQ(counters[plain_]["samples"].size() + 1, counters[bricks_]["samples"].size());
}

// With `drop`, accepting removes only the values of configurations that are skipped now. All other
// values in these files remain as they were last accepted, and are not reset to an earlier state.
TEST_F(AcceptTest, DroppingKeepsOtherAcceptedValues) {
  add_run("b", [&](record::Record& record, core::Image&) {
    record.counters["samples"] = 7;
    const bool skips = record.device == "opencl:pocl" && record.configuration == plain_;
    if (skips) record.outcome = record::Outcome::skipped;
  });
  const auto expect_accepted = [&] {
    const core::Json counters = read(baseline("counters.json"));
    EXPECT_EQ(counters[plain_]["samples"].count("opencl:pocl"), 0U);
    EXPECT_EQ(counters[plain_]["samples"]["gl:llvmpipe-egl"], 7);
    EXPECT_EQ(counters[bricks_]["samples"]["opencl:pocl"], 7);
  };
  (void)accept_run("b", {.only = "*", .drop = true});  // no baselines existed before
  expect_accepted();
  std::filesystem::remove_all(baseline("counters.json").parent_path());
  accept_first();
  (void)accept_run("b", {.only = "*", .drop = true});
  expect_accepted();
}

// A run of a single device replaces the data hash for that device's voxel format. The hashes for
// other formats remain.
TEST_F(AcceptTest, HashesForOtherVoxelFormatsAreKept) {
  const auto with_formats = [](record::Record& record, core::Image&) {
    record.factors["voxel"] = record.device == "vulkan:lavapipe" ? "f32" : "u8";
    record.data_hash = record.factors["voxel"];
  };
  add_run("a", with_formats);
  (void)accept_run("a");
  const core::Json before = read(baseline("images.json"));
  add_run("b", [&](record::Record& record, core::Image& image) {
    with_formats(record, image);
    if (record.device != "vulkan:lavapipe") record.outcome = record::Outcome::skipped;
  });
  (void)accept_run("b");
  EXPECT_EQ(read(baseline("images.json")), before);
}

// Another machine's mathematics library changes the last bits of reference images, and its
// compression library writes other files. The baselines must not change because of that.
TEST_F(AcceptTest, AReferenceImageIsReplacedOnlyIfItsColoursChange) {
  accept_first();
  const auto reference_moved_by = [](int ulps) {
    return AcceptRequest{.truth = [ulps](const record::Record& record) {
      core::Image image = truth_of(record.scene);
      for (float& value : image.rgba) {
        for (int i = 0; i < ulps; ++i) value = std::nextafter(value, 2.0F);
      }
      return image;
    }};
  };
  const std::string name = std::filesystem::relative(
      std::filesystem::directory_iterator(baseline("images"))->path(), baseline(""));
  const auto replaced = HasSubstr(name + ": replaced");
  const std::string file = text_of(baseline(name));
  const core::Json index = read(baseline("images.json"));
  EXPECT_THAT(accept_run("accepted", reference_moved_by(1)), Not(Contains(replaced)));
  EXPECT_EQ(text_of(baseline(name)), file);
  EXPECT_EQ(read(baseline("images.json")), index);
  EXPECT_THAT(accept_run("accepted", reference_moved_by(100000)), Contains(replaced));
  EXPECT_NE(read(baseline("images.json")), index);
  const std::string moved = text_of(baseline(name));
  EXPECT_NE(moved, file);
  rewrite(name, "not an image");
  EXPECT_THAT(accept_run("accepted", reference_moved_by(100000)), Contains(replaced));
  EXPECT_EQ(text_of(baseline(name)), moved);
}

TEST_F(AcceptTest, ValuesOfOtherDevicesAreKept) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    record.counters["samples"] = 7;
    if (record.device != "opencl:pocl") record.outcome = record::Outcome::crashed;
  });
  (void)accept_run("b");
  const core::Json samples = read(baseline("counters.json"))[plain_]["samples"];
  EXPECT_EQ(samples["opencl:pocl"], 7);
  EXPECT_EQ(samples["gl:llvmpipe-egl"], 1000000);
}

TEST_F(AcceptTest, ACounterThatIsNoLongerReportedIsDropped) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "opencl:pocl") record.counters.erase("rays");
    record.counters.erase("samples");
  });
  (void)accept_run("b");
  const core::Json counters = read(baseline("counters.json"))[plain_];
  EXPECT_FALSE(counters.contains("samples"));
  EXPECT_FALSE(counters["rays"].contains("opencl:pocl"));
  EXPECT_TRUE(counters["rays"].contains("vulkan:lavapipe"));
}

TEST_F(AcceptTest, TimesComeFromOneRun) {
  accept_first();
  const auto median = [&](const char* api) {
    return read(device_file("timings", api))["configurations"][plain_]["median_ns"].get<double>();
  };
  const double gl = median("gl");
  const double opencl = median("opencl");
  add_run("b", [](record::Record& record, core::Image&) {
    for (double& ns : record.wall_ns) ns *= 2;
    if (record.device == "gl:llvmpipe-egl") record.outcome = record::Outcome::failed;
  });
  (void)accept_run("b");
  EXPECT_EQ(median("gl"), gl);
  EXPECT_NEAR(median("opencl") / opencl, 2, 0.05);
}

// The checks of the plan decide whether images and times are stored. Its name does not matter.
TEST_F(AcceptTest, ImagesAndTimesAreStoredIfThePlanChecksThem) {
  checks_ = {Check::image, Check::timing};
  accept_first();
  EXPECT_TRUE(std::filesystem::exists(baseline("images")));
  EXPECT_TRUE(std::filesystem::exists(baseline("timings")));
  checks_ = {Check::timing};
  add_run("times");
  (void)accept_run("times");
  EXPECT_FALSE(std::filesystem::exists(baseline("images")));
  EXPECT_TRUE(std::filesystem::exists(baseline("timings")));
  checks_ = {Check::image};
  add_run("images");
  (void)accept_run("images");
  EXPECT_FALSE(std::filesystem::exists(baseline("images")));
  EXPECT_FALSE(std::filesystem::exists(baseline("timings")));
  EXPECT_EQ(read(baseline("images.json"))[front_]["reference"].size(), 2U);
}

TEST_F(AcceptTest, CostsFromTwoEmulatorsAreRejected) {
  const auto counted_by = [](const std::string& emulator) {
    return [emulator](record::Record& record, core::Image&) {
      record.cost = {{"device_code", 700}, {"driver", 300}, {"libc", 55}, {"allocations", 4}};
      record.prepare_cost = {{"driver", 9000}};
      record.counted_by = emulator;
    };
  };
  accept_first(counted_by("one"));
  const core::Json cost = read(device_file("cost", "vulkan"));
  EXPECT_EQ(cost["device"], "vulkan:lavapipe");
  EXPECT_EQ(cost["driver_version"], "22.3.6");
  EXPECT_EQ(cost["configurations"][plain_]["frame"],
            (core::Json{{"device_code", 700}, {"driver", 300}, {"allocations", 4}}));
  EXPECT_EQ(cost["configurations"][plain_]["prepare"]["driver"], 9000);
  add_run("b", counted_by("two"));
  EXPECT_THROW((void)accept_run("b", {.only = plain_}), core::InputError)
      << "values of another emulator would be lost";
  EXPECT_EQ(read(device_file("cost", "vulkan")), cost);
  (void)accept_run("b");
  EXPECT_EQ(read(device_file("cost", "vulkan"))["counted_by"], "two");
  EXPECT_EQ(read(device_file("cost", "vulkan"))["configurations"].size(), 4U);
  add_run("mixed", [&](record::Record& record, core::Image& image) {
    counted_by(record.configuration == plain_ ? "one" : "two")(record, image);
  });
  EXPECT_THROW((void)accept_run("mixed"), core::InputError);
}

TEST_F(AcceptTest, MemoryIsStoredPerDevice) {
  accept_first([](record::Record& record, core::Image&) {
    if (record.device != "opencl:pocl") record.memory = {{"buffers", 4096}};
  });
  EXPECT_EQ(read(baseline("memory.json"))[plain_].size(), 2U);
  EXPECT_EQ(read(baseline("memory.json"))[plain_]["gl:llvmpipe-egl"]["buffers"], 4096);
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "vulkan:lavapipe") record.memory = {{"buffers", 4096}};
  });
  (void)accept_run("b");
  EXPECT_EQ(read(baseline("memory.json"))[plain_].size(), 1U) << "one device no longer reports it";
}

TEST_F(AcceptTest, DataThatChangedSinceTheRunAreRejected) {
  add_run("a", [](record::Record& record, core::Image&) { record.data_hash = "0a0a"; });
  const auto with_current_hash = [](const std::string& hash) {
    return AcceptRequest{.data_hash = [hash](const record::Record&) { return hash; }};
  };
  try {
    (void)accept_run("a", with_current_hash("1b1b"));
    FAIL() << "no exception was thrown";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("content hash 0a0a, now 1b1b"));
  }
  EXPECT_FALSE(std::filesystem::exists(baseline("images.json")));
  (void)accept_run("a", with_current_hash("0a0a"));
  EXPECT_EQ(read(baseline("images.json"))[front_]["data"], "0a0a");
}

TEST_F(AcceptTest, RejectsUnsuitableRuns) {
  add_run("injected", [](record::Record& record, core::Image&) {
    if (record.configuration == bricks_) record.injected = "slowdown:20";
  });
  EXPECT_THROW((void)accept_run("injected"), core::InputError);
  EXPECT_THROW((void)accept_run("injected", {.only = plain_}), core::InputError);
  add_run("empty",
          [](record::Record& record, core::Image&) { record.outcome = record::Outcome::skipped; });
  EXPECT_THROW((void)accept_run("empty"), core::InputError);
  EXPECT_THROW((void)accept_run("unknown"), core::InputError);
  add_run("good");
  EXPECT_THROW((void)accept_run("good", {.only = "no such configuration"}), core::InputError);
  AcceptRequest blank;
  blank.plan = plan;
  blank.reason = "  ";
  EXPECT_THROW((void)accept(store_, "good", folder_.path() / "baselines", blank), core::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "baselines"));
}

TEST_F(AcceptTest, DamagedBaselinesAreNotExtended) {
  accept_first();
  const auto file = device_file("timings", "vulkan");
  core::write_file(std::string_view("<<<<<<< ours\n"), file);
  add_run("b", [](record::Record& record, core::Image&) { record.counters["samples"] = 7; });
  try {
    (void)accept_run("b");
    FAIL() << "no exception was thrown";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("was changed after it was accepted; restore the baselines from "));
  }
  EXPECT_EQ(text_of(file), "<<<<<<< ours\n");
  EXPECT_EQ(read(baseline("counters.json"))[plain_]["samples"]["opencl:pocl"], 1000000);
  EXPECT_THROW((void)accept_run("b", {.only = plain_, .drop = true}), core::InputError);
  (void)accept_run("b", {.drop = true});
  EXPECT_EQ(gate("b").exit_code(), core::ExitCode::pass) << text(gate("b"));
}

// All or nothing

class WholeAcceptTest : public AcceptTest {
 protected:
  // Returns the content of every file below the root folder of the baselines.
  [[nodiscard]] std::map<std::string, std::string> all_files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_.path() / "baselines" / "volume")) {
      const bool is_staged = entry.path().string().find(".accepting") != std::string::npos;
      if (entry.is_regular_file() && !is_staged) files[entry.path()] = text_of(entry.path());
    }
    return files;
  }
  void add_changed_run() {
    add_run("b", [](record::Record& record, core::Image& image) {
      record.counters["samples"] = 7;
      for (double& ns : record.wall_ns) ns *= 2;
      image.rgba[0] += 1e-5F;
    });
  }
};

TEST_F(WholeAcceptTest, AKillAtAnyStepChangesNothing) {
  accept_first();
  add_changed_run();
  const auto before = all_files();
  const int steps = static_cast<int>(before.size()) + 1;
  for (int step = 0; step < steps; ++step) {
    const pid_t child = ::fork();
    if (child == 0) {
      int left = step;
      (void)accept_run("b", {.on_written = [&](const std::string&) {
                         if (left-- == 0) ::_exit(42);
                       }});
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(WEXITSTATUS(status), 42) << step;
    ASSERT_EQ(all_files(), before) << step;
  }
  EXPECT_EQ(gate("accepted").exit_code(), core::ExitCode::pass) << text(gate("accepted"));
  (void)accept_run("b");
  EXPECT_EQ(gate("b").exit_code(), core::ExitCode::pass) << text(gate("b"));
  EXPECT_EQ(std::ranges::distance(
                std::filesystem::directory_iterator(folder_.path() / "baselines" / "volume")),
            1);
}

TEST_F(WholeAcceptTest, AnErrorWhileWritingChangesNothing) {
  accept_first();
  add_changed_run();
  const auto before = all_files();
  const auto fail_on_manifest = [](const std::string& file) {
    if (file == "manifest.json") throw core::IoError("disk full");
  };
  EXPECT_THROW((void)accept_run("b", {.on_written = fail_on_manifest}), core::IoError);
  EXPECT_EQ(all_files(), before);
}

TEST_F(WholeAcceptTest, OnlyOneAcceptRunsAtATime) {
  accept_first();
  add_changed_run();
  const auto accept_meanwhile = [&](const std::string& file) {
    if (!file.empty()) return;
    EXPECT_THROW((void)accept_run("accepted"), core::IoError);
  };
  (void)accept_run("b", {.on_written = accept_meanwhile});
  EXPECT_EQ(gate("b").exit_code(), core::ExitCode::pass) << text(gate("b"));
}

}  // namespace
}  // namespace triptych::judge
