// Tests runs that only check images and counters: values that were not measured are neither judged
// nor accepted.

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

TEST_F(UntimedGateTest, TimesAndStatisticsAreSkippedWithTheReason) {
  accept_first();
  add_run("b", untimed);
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::skipped, Check::statistics).size(), 12U);
  EXPECT_EQ(with(result, Verdict::pass, Check::counters).size(), 12U);
}

TEST_F(UntimedGateTest, ImagesAreStillJudged) {
  accept_first();
  add_run("b", [](record::Record& record, core::Image& image) {
    untimed(record, image);
    image.rgba[5] += 0.5F;
  });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::regression);
}

TEST_F(UntimedGateTest, StoredTimesAndStatisticsAreKept) {
  accept_first();
  const std::string timings = contents(device_file("timings", "vulkan"));
  const std::string statistics = contents(device_file("statistics", "vulkan"));
  add_run("b", untimed);
  EXPECT_THAT(accept_run("b"),
              Contains(HasSubstr("vulkan:lavapipe: kept the stored times and statistics of 4")));
  EXPECT_EQ(contents(device_file("timings", "vulkan")), timings);
  EXPECT_EQ(contents(device_file("statistics", "vulkan")), statistics);
}

// The plan judges statistics but not times.
TEST_F(UntimedGateTest, StatisticsThatWereReadAreAccepted) {
  const auto without_times = [](record::Record& record, core::Image&) {
    record.warm_up_frames = 0;
    record.wall_ns.clear();
  };
  add_run("a", without_times);
  (void)accept_run("a");
  EXPECT_FALSE(std::filesystem::exists(baseline("timings")));
  add_run("b", without_times);
  const GateResult result = gate("b");  // one of three devices reports no statistics
  EXPECT_EQ(with(result, Verdict::pass, Check::statistics).size(), 8U) << text(result);
}

// The first run is accepted without times, so nothing that looks like a time may be stored.
TEST_F(UntimedGateTest, MissingTimesAreNotAccepted) {
  add_run("a", untimed);
  (void)accept_run("a");
  EXPECT_FALSE(std::filesystem::exists(baseline("timings")));
  EXPECT_FALSE(std::filesystem::exists(baseline("statistics")));
  add_run("b", untimed);
  EXPECT_EQ(gate("b").exit_code(), ExitCode::pass) << text(gate("b"));
}

// A time that was never stored is new, not missing. This is tested for devices without any stored
// times, and for devices with a stored time of only one configuration.
TEST_F(UntimedGateTest, LaterTimesAreNewAndOnlyAdvisory) {
  add_run("a", untimed);
  (void)accept_run("a");
  add_run("b");
  EXPECT_EQ(with(gate("b"), Verdict::advisory, Check::timing).size(), 3U) << text(gate("b"));
  EXPECT_TRUE(with(gate("b"), Verdict::cannot_judge, Check::timing).empty()) << text(gate("b"));
  (void)accept_run("b", {.only = bricks_});
  add_run("c");
  EXPECT_EQ(with(gate("c"), Verdict::advisory, Check::timing).size(), 6U) << text(gate("c"));
  EXPECT_TRUE(with(gate("c"), Verdict::cannot_judge, Check::timing).empty()) << text(gate("c"));
}

}  // namespace
}  // namespace triptych::judge
