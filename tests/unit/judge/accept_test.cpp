#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "fixture.hpp"
#include "judge/baselines/json_file.hpp"

namespace triptych::judge {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

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
  EXPECT_EQ(read(device_file("bits", "gl"))["configurations"].size(), 4U);
  EXPECT_EQ(read(device_file("timings", "opencl"))["configurations"][plain_][0]["run"], "a");
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

TEST_F(AcceptTest, OnlyWhatIsAskedForIsReplaced) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) { record.counters["samples"] = 7; });
  (void)accept_run("b", {.only = "*skip=bricks*"});
  const core::Json counters = read(baseline("counters.json"));
  EXPECT_EQ(counters[bricks_]["samples"]["opencl:pocl"], 7);
  EXPECT_EQ(counters[plain_]["samples"]["opencl:pocl"], 1000000);
}

TEST_F(AcceptTest, WhatThePlanNoLongerHoldsIsDropped) {
  add_run("a");
  (void)accept_run("a");
  core::write_file(std::string_view("stale"), baseline("images/0123.exr"));
  store_.add_run({"b", plan, "2026-02-02T00:00:00Z", {}});
  for (record::Record record : store_.records("a")) {
    record.run = "b";
    if (record.scene == front_) store_.add_record(record);
  }
  for (const auto& entry : store_.devices("a")) store_.add_device("b", entry.device, {});
  EXPECT_THROW((void)accept_run("b"), core::InputError);
  EXPECT_EQ(read(baseline("counters.json")).size(), 4U);
  EXPECT_THAT(accept_run("b", {.drop = true}), Contains("images/0123.exr: removed"));
  EXPECT_EQ(read(baseline("counters.json")).size(), 2U);
  EXPECT_EQ(read(baseline("images.json")).size(), 1U);
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(baseline("images"))), 1);
}

// One device's run replaces its own voxel format's hash, and leaves the others'.
TEST_F(AcceptTest, DataOfOtherFormatsKeepsItsHash) {
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

TEST_F(AcceptTest, OtherDevicesKeepWhatTheyHad) {
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

TEST_F(AcceptTest, ACounterThatIsNoLongerToldIsDropped) {
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

TEST_F(AcceptTest, KeepsTheLastTwentyTimings) {
  for (int i = 0; i < 22; ++i) {
    add_run(std::to_string(i));
    (void)accept_run(std::to_string(i), {.only = plain_});
  }
  const core::Json runs = read(device_file("timings", "gl"))["configurations"][plain_];
  ASSERT_EQ(runs.size(), 20U);
  EXPECT_EQ(runs.front()["run"], "2");
  EXPECT_EQ(runs.back()["run"], "21");
}

TEST_F(AcceptTest, ForgetsTimesWhereItIsAskedTo) {
  add_run("a");
  (void)accept_run("a");
  add_run("b", [](record::Record& record, core::Image&) {
    if (record.device == "gl:llvmpipe-egl") record.outcome = record::Outcome::failed;
  });
  (void)accept_run("b", {.forget_times = true});
  const auto runs = [&](const char* api) {
    return read(device_file("timings", api))["configurations"][plain_];
  };
  ASSERT_EQ(runs("opencl").size(), 1U);
  EXPECT_EQ(runs("opencl")[0]["run"], "b");
  ASSERT_EQ(runs("gl").size(), 1U);
  EXPECT_EQ(runs("gl")[0]["run"], "a");
}

TEST_F(AcceptTest, RefusesWhatIsNoBaseline) {
  add_run("planted", [](record::Record& record, core::Image&) {
    if (record.configuration == bricks_) record.planted = "slowdown:20";
  });
  EXPECT_THROW((void)accept_run("planted"), core::InputError);
  EXPECT_THROW((void)accept_run("planted", {.only = plain_}), core::InputError);
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

TEST_F(AcceptTest, ACorruptBaselineIsNotOverwritten) {
  add_run("a");
  (void)accept_run("a");
  const auto file = device_file("timings", "vulkan");
  core::write_file(std::string_view("<<<<<<< ours\n"), file);
  add_run("b", [](record::Record& record, core::Image&) { record.counters["samples"] = 7; });
  EXPECT_THROW((void)accept_run("b"), core::InputError);
  EXPECT_EQ(text_of(file), "<<<<<<< ours\n");
  EXPECT_EQ(read(baseline("counters.json"))[plain_]["samples"]["opencl:pocl"], 1000000);
}

}  // namespace
}  // namespace triptych::judge
