// Statistics of a new driver version, judged by the calibrations of this driver and of the stored
// ones.

#include <gmock/gmock.h>

#include "fixture.hpp"
#include "judge/baselines/baselines.hpp"

namespace triptych::judge {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Calibration = std::map<std::string, std::string>;

const Calibration exact{{"compute_invocations", "exact"}};
const Calibration doubled{{"compute_invocations", "proportional: 2 times the true number"}};

class CalibrationGateTest : public JudgeTest {
 protected:
  // What is said of a new version of lavapipe, whose calibration is `own` and which counts 49
  // instead of 48, where only GL's numbers are stored.
  std::string advice(const Calibration& stored, const Calibration& own) {
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
    return advice.empty() ? std::string() : advice[0].message;
  }
};

// It tells another number of the same picture each time: nothing that a driver could be held to.
TEST_F(CalibrationGateTest, WhatIsUnsteadyIsNotHeldToWhatIsStored) {
  const auto verdict_of = [&](const std::string& run, const std::string& worth) {
    calibrations_["vulkan:lavapipe"] = {{"fragment_invocations", worth}};
    add_run(run, [](record::Record& record, core::Image&) {
      if (record.device == "vulkan:lavapipe") ++record.statistics["fragment_invocations"];
    });
    return gate(run).exit_code();
  };
  accept_first();
  EXPECT_EQ(verdict_of("b", "unsteady: 4, and 8 when drawn again"), core::ExitCode::pass);
  EXPECT_THAT(text(gate("b")),
              HasSubstr("1 statistics as stored; unsteady, so not compared: fragment_invocations"));
  EXPECT_EQ(verdict_of("c", "exact"), core::ExitCode::regression);
}

TEST_F(CalibrationGateTest, WhatBothCountExactlyIsCompared) {
  EXPECT_THAT(advice(exact, exact), AllOf(HasSubstr("compute_invocations 49, but 48 on gl-"),
                                          Not(HasSubstr("not compared"))));
}

TEST_F(CalibrationGateTest, WhatThisDriverCountsOtherwiseIsNotCompared) {
  EXPECT_THAT(advice(exact, doubled),
              AllOf(HasSubstr("no number of it can be held against the stored ones"),
                    HasSubstr("not compared: compute_invocations (here proportional: 2 times"),
                    Not(HasSubstr("differs from"))));
}

TEST_F(CalibrationGateTest, WhatTheStoredDriverCountsOtherwiseIsNotCompared) {
  EXPECT_THAT(advice(doubled, exact),
              AllOf(HasSubstr("not compared: compute_invocations (on gl-llvmpipe-egl"),
                    HasSubstr("proportional: 2 times"), Not(HasSubstr("differs from"))));
}

TEST_F(CalibrationGateTest, WhatNoSceneShowedIsNotCompared) {
  EXPECT_THAT(advice(exact, {{"vertex_invocations", "exact"}}),
              HasSubstr("compute_invocations (here not calibrated)"));
}

TEST_F(CalibrationGateTest, ADriverWithoutACalibrationIsComparedAsItIs) {
  EXPECT_THAT(advice({}, exact), HasSubstr("compute_invocations 49, but 48 on gl-"));
}

TEST_F(CalibrationGateTest, ARunWithoutACalibrationStillHeedsTheStoredOne) {
  EXPECT_THAT(advice(doubled, {}), HasSubstr("not compared: compute_invocations (on gl-"));
}

TEST_F(CalibrationGateTest, ARunThatDidNotLookKeepsTheStoredCalibration) {
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

// A part of a plan asks for fewer statistics.
TEST_F(CalibrationGateTest, ARunThatLookedAtSomeKeepsWhatIsStoredOfTheOthers) {
  calibrations_["gl:llvmpipe-egl"] = {{"compute_invocations", "exact"},
                                      {"fragment_invocations", "exact"}};
  add_run("a");
  (void)accept_run("a");
  calibrations_["gl:llvmpipe-egl"] = {{"compute_invocations", "unsteady"}};
  add_run("b");
  (void)accept_run("b");
  EXPECT_THAT(Baselines(folder_.path() / "baselines", plan)
                  .statistics_calibration(device_file("statistics", "gl").stem().string()),
              testing::UnorderedElementsAre(testing::Pair("compute_invocations", "unsteady"),
                                            testing::Pair("fragment_invocations", "exact")));
}

}  // namespace
}  // namespace triptych::judge
