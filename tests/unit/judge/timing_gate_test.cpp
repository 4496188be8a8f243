// Tests that times are always reported, but affect the verdict only on request.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;

class TimingGateTest : public JudgeTest {
 protected:
  TimingGateTest() { request_.checks = {Check::timing}; }

  // Returns a change that multiplies all times by a factor, for one configuration or for all.
  static Tweak scaled_times(double factor, const std::string& configuration = {}) {
    return [=](record::Record& record, core::Image&) {
      if (!configuration.empty() && record.configuration != configuration) return;
      for (double& ns : record.wall_ns) ns *= factor;
    };
  }
  static Tweak with_device_clock(const Tweak& tweak) {
    return [tweak](record::Record& record, core::Image& image) {
      tweak(record, image);
      record.device_ns = record.wall_ns;
      record.device_clock_trusted = true;
    };
  }
};

TEST_F(TimingGateTest, TwiceAsSlowIsShownWithoutAVerdict) {
  accept_first();
  add_run("b", scaled_times(2, bricks_));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(with(result, Verdict::pass, Check::timing).size(), 12U);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 3U) << text(result);  // one for each device
  EXPECT_EQ(advice[0].number("configurations"), 4);
  EXPECT_EQ(advice[0].fact("configuration"), bricks_);
  EXPECT_EQ(advice[0].advice.advice, Advice::times);
  EXPECT_NEAR(advice[0].numbers.at("ratio"), 1, 0.02);
  EXPECT_NEAR(advice[0].numbers.at("worst_ratio"), 2, 0.05);
}

TEST_F(TimingGateTest, EveryRatioIsReported) {
  accept_first();
  add_run("b", scaled_times(1.5));
  for (const Finding& each : with(gate("b"), Verdict::pass, Check::timing)) {
    EXPECT_NEAR(each.numbers.at("ratio"), 1.5, 0.04);
    // Two runs are compared, each with a scatter of at least 0.5 %, so the interval cannot be
    // narrower than this.
    EXPECT_GE(each.numbers.at("half_width"), 1.96 * std::hypot(0.005, 0.005) - 1e-9);
    EXPECT_LT(each.numbers.at("half_width"), 0.06);
    EXPECT_NEAR(each.numbers.at("median_ns") / each.numbers.at("baseline_ns"), 1.5, 0.04);
  }
}

TEST_F(TimingGateTest, OnRequestASlowerConfigurationIsARegression) {
  accept_first();
  request_.times_decide = true;
  add_run("b", scaled_times(1.2, bricks_));
  const GateResult result = gate("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 3U) << text(result);
  EXPECT_EQ(slower[0].configuration, bricks_);
  EXPECT_EQ(slower[0].fact("work"), "samples");
  EXPECT_EQ(slower[0].number("work_ratio"), 1);
  add_run("c", scaled_times(0.8, bricks_));
  EXPECT_EQ(gate("c").exit_code(), ExitCode::pass);
  EXPECT_EQ(with(gate("c"), Verdict::improved).size(), 3U);
}

// Tests times close to the limit: a slowdown is reported only if the ratio minus its interval
// exceeds 2 %.
TEST_F(TimingGateTest, AnUncertainSlowdownIsNotARegression) {
  const auto steady = [](double factor) {
    return
        [factor](record::Record& record, core::Image&) { record.wall_ns.assign(9, 1e6 * factor); };
  };
  const double half_width = 1.96 * std::hypot(0.005, 0.005);
  accept_first(steady(1));
  request_.times_decide = true;
  add_run("within", steady(std::exp(std::log(1.02) + half_width - 1e-6)));
  EXPECT_EQ(gate("within").exit_code(), ExitCode::pass) << text(gate("within"));
  add_run("beyond", steady(std::exp(std::log(1.02) + half_width + 1e-6)));
  EXPECT_EQ(gate("beyond").exit_code(), ExitCode::regression);
}

TEST_F(TimingGateTest, SpreadIncludesFramesAndClock) {
  EXPECT_DOUBLE_EQ(log_spread({100, 100, 100}), 0.005);
  EXPECT_NEAR(log_spread({90, 95, 100, 105, 110}), 1.4826 * std::log(105.0 / 100), 1e-2);
  // The clock is coarse: all frames except one last the same number of clock ticks.
  EXPECT_NEAR(log_spread({10, 10, 10, 10, 11}), std::log(1.1), 1e-12);
}

TEST_F(TimingGateTest, ClocksAreNotMixed) {
  accept_first(with_device_clock(scaled_times(1)));
  add_run("wall", scaled_times(1));
  EXPECT_TRUE(with(gate("wall"), Verdict::pass, Check::timing).empty());
  const auto advice = with(gate("wall"), Verdict::advisory);
  ASSERT_EQ(advice.size(), 3U) << text(gate("wall"));
  EXPECT_EQ(advice[0].cause, Cause::other_clock);
  EXPECT_EQ(advice[0].names.size(), 4U);
  request_.times_decide = true;
  EXPECT_EQ(gate("wall").exit_code(), ExitCode::cannot_judge);
}

// All frames are also timed by the wall clock, so wall times can be compared.
TEST_F(TimingGateTest, AStoredWallTimeIsComparedWithWallTime) {
  accept_first();
  add_run("b", [](record::Record& record, core::Image& image) {
    with_device_clock(scaled_times(1))(record, image);
    for (double& ns : record.device_ns) ns /= 3;
  });
  for (const Finding& each : with(gate("b"), Verdict::pass, Check::timing)) {
    EXPECT_NEAR(each.numbers.at("ratio"), 1, 0.03);
  }
  EXPECT_EQ(with(gate("b"), Verdict::pass, Check::timing).size(), 12U);
}

TEST_F(TimingGateTest, ADeviceWithoutStoredTimesIsOneFinding) {
  accept_first();
  driver_versions_["vulkan:lavapipe"] = "23.0";
  add_run("b");
  const auto unknown = [](const std::vector<Finding>& findings) {
    return std::ranges::count_if(
        findings, [](const Finding& finding) { return finding.cause == Cause::no_stored_device; });
  };
  EXPECT_EQ(unknown(with(gate("b"), Verdict::advisory)), 1) << text(gate("b"));
  request_.times_decide = true;
  EXPECT_EQ(unknown(with(gate("b"), Verdict::cannot_judge)), 1) << text(gate("b"));
}

TEST_F(TimingGateTest, NewDeviceCodeIsReported) {
  accept_first();
  add_run("b", [](record::Record& record, core::Image&) { record.kernel_hash = "new"; });
  EXPECT_EQ(with(gate("b"), Verdict::pass, Check::timing).at(0).fact("kernel_hash"), "new");
}

TEST_F(TimingGateTest, AMissingTimeDoesNotPass) {
  accept_first();
  add_run("b", [](record::Record& record, core::Image&) { record.wall_ns.clear(); });
  EXPECT_EQ(gate("b").exit_code(), ExitCode::cannot_judge);
}

}  // namespace
}  // namespace triptych::judge
