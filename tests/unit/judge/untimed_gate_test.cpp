// Runs for pictures and counters alone: what was not measured is neither judged nor accepted.

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::Contains;
using testing::HasSubstr;

void untimed(record::Record& record, core::Image&) {
  record.warm_up_frames = 0;
  record.wall_ns.clear();
  record.statistics.clear();
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class UntimedGateTest : public JudgeTest {};

TEST_F(UntimedGateTest, StatisticsAreSkippedWithTheReason) {
  accept_history();
  add_run("b", untimed);
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::skipped, Check::statistics).size(), 12U);
  EXPECT_EQ(with(result, Verdict::pass, Check::counters).size(), 12U);
}

TEST_F(UntimedGateTest, ThePictureIsJudgedAllTheSame) {
  accept_history();
  add_run("b", [](record::Record& record, core::Image& image) {
    untimed(record, image);
    image.rgba[5] += 0.5F;
  });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(UntimedGateTest, WhatIsStoredOfTimesAndStatisticsStays) {
  accept_history();
  const std::string timings = contents(device_file("timings", "vulkan"));
  const std::string statistics = contents(device_file("statistics", "vulkan"));
  add_run("b", untimed);
  EXPECT_THAT(accept_run("b"), Contains(HasSubstr("vulkan:lavapipe: times and statistics of 4")));
  EXPECT_EQ(contents(device_file("timings", "vulkan")), timings);
  EXPECT_EQ(contents(device_file("statistics", "vulkan")), statistics);
}

// Accepted without times first: nothing that reads like a time is stored.
TEST_F(UntimedGateTest, AcceptsNoMissingTimeAsATime) {
  add_run("a", untimed);
  (void)accept_run("a");
  EXPECT_FALSE(std::filesystem::exists(baseline("timings")));
  EXPECT_FALSE(std::filesystem::exists(baseline("statistics")));
  add_run("b", untimed);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
}

}  // namespace
}  // namespace triptych::judge
