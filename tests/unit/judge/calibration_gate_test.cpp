// Tests how pipeline statistics of a new driver version are compared with stored statistics. A
// calibration states how correctly a driver version counts each statistic. Whether numbers can be
// compared depends on the calibrations of both versions.

#include <gmock/gmock.h>

#include <algorithm>

#include "fixture.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::judge {
namespace {

using record::Worth;
using Calibration = std::map<std::string, record::StatisticWorth>;

const Calibration exact{{"compute_invocations", {}}};
const Calibration doubled{
    {"compute_invocations", {.worth = Worth::proportional, .low = 2, .high = 2}}};

class CalibrationGateTest : public JudgeTest {
 protected:
  // Returns the finding about a new version of lavapipe that has the calibration `own` and counts
  // 49 compute invocations. The only stored statistics are those of the OpenGL device, which has
  // the calibration `stored` and counts 48.
  Finding advice(const Calibration& stored, const Calibration& own) {
    calibrations_["gl:llvmpipe-egl"] = stored;
    accept_first([](record::Record& record, core::Image&) {
      if (record.device == "vulkan:lavapipe") record.statistics.clear();
    });
    calibrations_["vulkan:lavapipe"] = own;
    add_run("b", [](record::Record& record, core::Image&) {
      if (record.device == "vulkan:lavapipe") record.statistics = {{"compute_invocations", 49}};
    });
    const GateResult result = gate("b");
    EXPECT_EQ(result.exit_code(), core::ExitCode::pass) << text(result);
    const auto advice = with(result, Verdict::advisory, Check::statistics);
    EXPECT_EQ(advice.size(), 1U);
    return advice.empty() ? Finding{} : advice[0];
  }
};

// The driver reports a different number for the same image each time, so the number is not compared
// with a stored one.
TEST_F(CalibrationGateTest, UnsteadyStatisticsAreNotCompared) {
  const auto verdict_of = [&](const std::string& run, Worth worth) {
    calibrations_["vulkan:lavapipe"] = {{"fragment_invocations", {.worth = worth}}};
    add_run(run, [](record::Record& record, core::Image&) {
      if (record.device == "vulkan:lavapipe") ++record.statistics["fragment_invocations"];
    });
    return gate(run).exit_code();
  };
  accept_first();
  EXPECT_EQ(verdict_of("b", Worth::unsteady), core::ExitCode::pass);
  const auto compared = with(gate("b"), Cause::as_stored);
  EXPECT_TRUE(std::ranges::any_of(compared, [](const Finding& each) {
    return each.names == std::vector<std::string>{"fragment_invocations"};
  }));
  EXPECT_EQ(verdict_of("c", Worth::exact), core::ExitCode::regression);
}

TEST_F(CalibrationGateTest, ExactStatisticsAreCompared) {
  const Finding finding = advice(exact, exact);
  const Change change = change_of(finding, "compute_invocations");
  EXPECT_EQ(change.now, 49);
  EXPECT_THAT(change.accepted, testing::ElementsAre(testing::Pair(testing::_, 48)));
  EXPECT_THAT(finding.names, testing::IsEmpty());
}

TEST_F(CalibrationGateTest, StatisticsThatThisDriverCountsDifferentlyAreNotCompared) {
  const Finding finding = advice(exact, doubled);
  EXPECT_THAT(finding.changes, testing::IsEmpty());
  EXPECT_EQ(finding.number("compared"), 0);
  EXPECT_THAT(finding.names, testing::ElementsAre("compute_invocations: proportional"));
}

TEST_F(CalibrationGateTest, StatisticsThatTheStoredDriverCountsDifferentlyAreNotCompared) {
  const Finding finding = advice(doubled, exact);
  EXPECT_THAT(finding.changes, testing::IsEmpty());
  EXPECT_THAT(finding.names,
              testing::ElementsAre(testing::StartsWith("compute_invocations on gl-llvmpipe-egl")));
}

TEST_F(CalibrationGateTest, UncalibratedStatisticsAreNotCompared) {
  EXPECT_THAT(advice(exact, {{"vertex_invocations", {}}}).names,
              testing::ElementsAre("compute_invocations: not_calibrated"));
}

TEST_F(CalibrationGateTest, ADriverWithoutACalibrationIsComparedDirectly) {
  EXPECT_EQ(change_of(advice({}, exact), "compute_invocations").now, 49);
}

TEST_F(CalibrationGateTest, ARunWithoutACalibrationUsesTheStoredOne) {
  EXPECT_THAT(advice(doubled, {}).names, testing::SizeIs(1));
}

TEST_F(CalibrationGateTest, ARunWithoutCalibrationKeepsTheStoredOne) {
  calibrations_["gl:llvmpipe-egl"] = exact;
  add_run("a");
  (void)accept_run("a");
  calibrations_.clear();
  add_run("b");
  (void)accept_run("b");
  const Baselines stored(folder_.path() / "baselines", plan);
  EXPECT_EQ(stored.statistics_calibration(device_file("statistics", "gl").stem().string()), exact);
  EXPECT_TRUE(
      stored.statistics_calibration(device_file("statistics", "vulkan").stem().string()).empty());
}

// A run of a part of the plan calibrates only some statistics.
TEST_F(CalibrationGateTest, APartialCalibrationKeepsTheOtherStatistics) {
  calibrations_["gl:llvmpipe-egl"] = {{"compute_invocations", {}}, {"fragment_invocations", {}}};
  add_run("a");
  (void)accept_run("a");
  calibrations_["gl:llvmpipe-egl"] = {{"compute_invocations", {.worth = Worth::unsteady}}};
  add_run("b");
  (void)accept_run("b");
  EXPECT_THAT(
      Baselines(folder_.path() / "baselines", plan)
          .statistics_calibration(device_file("statistics", "gl").stem().string()),
      testing::UnorderedElementsAre(
          testing::Pair("compute_invocations", record::StatisticWorth{.worth = Worth::unsteady}),
          testing::Pair("fragment_invocations", record::StatisticWorth{})));
}

}  // namespace
}  // namespace triptych::judge
