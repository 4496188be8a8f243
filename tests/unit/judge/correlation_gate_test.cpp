// What the gate says of a device that nobody accepted, by another device's baselines.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/json.hpp"
#include "correlation_fixture.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(CorrelationGateTest, ASlowerDevicePasses) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto passed = with(result, Verdict::pass, Check::correlation);
  ASSERT_EQ(passed.size(), 1U);
  EXPECT_EQ(passed[0].device, "b:new");
  EXPECT_NEAR(passed[0].numbers.at("slope"), 1, 0.02);
  EXPECT_EQ(passed[0].numbers.at("anchors"), 12);
  EXPECT_THAT(passed[0].message, HasSubstr("as a:known; driver 1 lets expect"));
  EXPECT_EQ(passed[0].test, "volume.correlation.correlation.b:new");
  ASSERT_EQ(result.correlations.size(), 1U);
  EXPECT_EQ(result.correlations[0].other, "a:known");
  EXPECT_EQ(result.correlations[0].cases.size(), 60U);
}

TEST_F(CorrelationGateTest, OneConfigurationIsNamedWithItsWork) {
  accept_known();
  measure_anchors("anchors", "b:new");
  const std::string planted = "data=d2,step=3,technique=raycast_fragment";
  measure("b", "b:new",
          [&](const record::Record& r) { return r.configuration == planted ? 1.25 : 1; });
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 1U) << text(result);
  EXPECT_EQ(slower[0].configuration, planted);
  EXPECT_THAT(slower[0].message, HasSubstr("work (samples) +0.0 %, time per unit of work +2"));
}

// Two of three slow configurations were a slow minute: the quieter launch says what is left, and
// the others are told as advice.
TEST_F(CorrelationGateTest, AnotherLaunchTakesBackASlowMinute) {
  accept_known();
  const std::string planted = "data=d2,step=3,technique=raycast_fragment";
  measure_anchors("anchors", "b:new");
  measure("b", "b:new", [&](const record::Record& r) {
    const bool slow_minute = r.configuration.starts_with("data=d0,step=5");
    return r.configuration == planted ? 1.25 : slow_minute ? 1.4 : 1;
  });
  const GateResult alone = judge("b");
  EXPECT_EQ(with(alone, Verdict::regression).size(), 3U) << text(alone);
  EXPECT_EQ(alone.in_doubt, std::set<std::string>{"b:new"});
  measure("c", "b:new",
          [&](const record::Record& r) { return r.configuration == planted ? 1.3 : 1; });
  confirm("b", "c", plan);
  const GateResult result = judge("b");
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 1U) << text(result);
  EXPECT_EQ(slower[0].configuration, planted);
  EXPECT_NEAR(slower[0].numbers.at("ratio"), 1.25, 0.04);
  EXPECT_THAT(slower[0].message, HasSubstr("so too on a fresh launch"));
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 2U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("not so on a fresh launch"));
}

// A little more scatter than a line may have is worth another launch; several times as much is not.
TEST_F(CorrelationGateTest, WhatIsRefusedForNoiseIsInDoubt) {
  accept_known();
  measure_anchors("anchors", "b:new");
  const auto noisy = [](double size) {
    return [=, i = 0](const record::Record&) mutable {
      return std::exp(size * std::sin(12.9898 * ++i));
    };
  };
  measure("b", "b:new", noisy(0.12));
  const GateResult result = judge("b");
  ASSERT_EQ(result.correlations.size(), 1U);
  EXPECT_TRUE(result.correlations[0].result.refused_for_scatter()) << text(result);
  EXPECT_EQ(result.in_doubt, std::set<std::string>{"b:new"});
  measure("c", "b:new", noisy(0.6));
  EXPECT_FALSE(judge("c").correlations[0].result.admitted());
  EXPECT_TRUE(judge("c").in_doubt.empty());
}

TEST_F(CorrelationGateTest, FewStoredRunsAdvise) {
  accept_known(TimingModel::least_runs - 1);
  measure_anchors("anchors", "b:new");
  const std::string planted = "data=d2,step=3,technique=raycast_fragment";
  measure("b", "b:new",
          [&](const record::Record& r) { return r.configuration == planted ? 1.25 : 1; });
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_EQ(advice[0].configuration, planted);
  EXPECT_THAT(advice[0].message, HasSubstr("advice only: 4 of 5 stored runs"));
  EXPECT_TRUE(with(result, Verdict::pass).empty());
}

// What could not have failed has not passed.
TEST_F(CorrelationGateTest, FewStoredRunsPassNothing) {
  accept_known(TimingModel::least_runs - 1);
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_THAT(with(result, Verdict::advisory).at(0).message,
              AllOf(HasSubstr("as a:known; driver 1 lets expect"),
                    HasSubstr("advice only: 4 of 5 stored runs")));
}

TEST_F(CorrelationGateTest, ADeviceThatIsNotThereIsNoCrash) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  request_.devices = {"no:such"};
  EXPECT_EQ(judge("b").exit_code(), ExitCode::cannot_judge);
  EXPECT_EQ(judge("never measured").exit_code(), ExitCode::cannot_judge);
}

TEST_F(CorrelationGateTest, AWholeLevelIsNamed) {
  accept_known();
  measure_anchors("anchors", "b:new");
  const Times slower = [](const record::Record& r) {
    return r.factors.at("data") == "d1" ? 1.2 : 1;
  };
  measure("b", "b:new", slower);
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  bool named = false;
  for (const Finding& finding : with(result, Verdict::regression)) {
    named = named || finding.message.starts_with("data=d1: 12 configurations +");
  }
  EXPECT_TRUE(named) << text(result);
}

// Half of all by a quarter leaves no line of all; that of the others names it.
TEST_F(CorrelationGateTest, HalfOfAllIsNamed) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new", [](const record::Record& r) {
    return r.factors.at("technique") == "raycast" ? 1.25 : 1;
  });
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression) << text(result);
  const auto named = with(result, Verdict::regression);
  const auto level = std::ranges::find_if(named, [](const Finding& finding) {
    return finding.message.starts_with("technique=raycast: 24 configurations +25.");
  });
  ASSERT_NE(level, named.end()) << text(result);
  EXPECT_THAT(level->message, HasSubstr("; the line is that of the others"));
  EXPECT_EQ(named.size(), 25U);
}

TEST_F(CorrelationGateTest, AFewPercentOnALevelOnlyAdvise) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new",
          [](const record::Record& r) { return r.factors.at("data") == "d1" ? 1.06 : 1; });
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_FALSE(advice.empty());
  EXPECT_THAT(advice[0].message, HasSubstr("data=d1"));
  EXPECT_THAT(advice[0].message, HasSubstr("triptych compare"));
}

TEST_F(CorrelationGateTest, AnchorsTellAProgramThatIsSlowerAsAWhole) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new", [](const record::Record&) { return 1.15; });
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 1U) << text(result);
  EXPECT_THAT(slower[0].message, HasSubstr("the whole program"));
  EXPECT_NEAR(slower[0].numbers.at("global_delta"), std::log(1.15), 0.03);
}

TEST_F(CorrelationGateTest, WithoutAnchorsNothingIsJudged) {
  accept_known();
  measure("b", "b:new");
  const GateResult result = judge("b");
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("0 anchors, 6 are needed"));
  EXPECT_THAT(advice[0].message, HasSubstr("triptych run anchors/frozen"));
}

TEST_F(CorrelationGateTest, AnchorsOfAnotherDriverAreNoAnchors) {
  accept_known();
  store_.add_run({"anchors", anchors, "2026-02-01T00:00:00Z", {}});
  measure_anchors("anchors", "b:new");
  record::Device updated = device("b:new");
  updated.driver_version = "2";
  store_.add_device("anchors", updated, {});
  measure("b", "b:new");
  EXPECT_EQ(judge("b").correlations.at(0).result.anchors, 0U);
}

// The device's clock says something else altogether, so that mixing the two would show.
TEST_F(CorrelationGateTest, DevicesOfUnlikeClocksAreComparedByTheWall) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  for (record::Record record : store_.records("b")) {
    if (record.technique != "raycast") continue;
    record.device_ns = record.wall_ns;
    for (double& ns : record.device_ns) ns /= 5;
    record.device_clock_trusted = true;
    store_.add_record(record);
  }
  const GateResult result = judge("b");
  const CorrelationPair& pair = result.correlations.at(0);
  EXPECT_EQ(pair.unlike_clocks, 0U);
  EXPECT_TRUE(pair.result.admitted()) << text(result);
  EXPECT_TRUE(with(result, Verdict::regression).empty()) << text(result);
}

TEST_F(CorrelationGateTest, WhatHasNoCommonClockIsLeftOut) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  for (record::Record record : store_.records("b")) {
    if (record.technique != "raycast") continue;
    record.device_ns = std::exchange(record.wall_ns, {});
    record.device_clock_trusted = true;
    store_.add_record(record);
  }
  const GateResult result = judge("b");
  EXPECT_EQ(result.correlations.at(0).unlike_clocks, 24U);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("24 configurations with like clocks, 30 are needed"));
}

TEST_F(CorrelationGateTest, WhatWasAcceptedOnThisDeviceIsItsCharacter) {
  accept_known();
  const std::string odd = "data=d2,step=3,technique=raycast_fragment";
  const Times character = [&](const record::Record& r) { return r.configuration == odd ? 1.3 : 1; };
  measure_anchors("anchors", "b:new");
  accept_plan("anchors", anchors);
  measure("b1", "b:new", character);
  accept_plan("b1", plan);
  measure("b2", "b:new", character);
  const GateResult result = judge("b2");
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 2U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("cannot be judged by its own history: 0 anchors"));
  EXPECT_THAT(advice[1].message, HasSubstr("as when this device was accepted"));
}

// Accepted once, it needs no like device to tell a tenth: its own anchors and times of then do.
TEST_F(CorrelationGateTest, AProgramThatBecameSlowerSinceAcceptanceIsTold) {
  accept_known();
  measure_anchors("anchors1", "b:new");
  accept_plan("anchors1", anchors);
  measure("b1", "b:new");
  accept_plan("b1", plan);
  measure_anchors("anchors2", "b:new");
  measure("b2", "b:new", [](const record::Record&) { return 1.10; });
  const GateResult result = judge("b2");
  EXPECT_EQ(result.exit_code(), ExitCode::regression) << text(result);
  const auto slower = with(result, Verdict::regression);
  ASSERT_EQ(slower.size(), 1U) << text(result);
  EXPECT_THAT(slower[0].message, HasSubstr("the whole program became +"));
  EXPECT_THAT(slower[0].message, HasSubstr("slower since this device was accepted"));
  EXPECT_NEAR(slower[0].numbers.at("global_delta"), std::log(1.10), 0.01);
}

TEST_F(CorrelationGateTest, TheFirstAcceptedRunHasNobodyToBeHeldAgainst) {
  accept_known(1);
  const GateResult result = judge("a:known 1 plan");
  EXPECT_TRUE(result.correlations.empty());
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U);
  EXPECT_THAT(advice[0].message, HasSubstr("no other device is stored"));
}

TEST_F(CorrelationGateTest, DevicesOfOneRunAreShownAndNotJudged) {
  accept_known();
  measure("b", "b:new");
  store_.add_device("b", device("a:known"), {});
  for (record::Record record : store_.records("b")) {
    record.device = "a:known";
    store_.add_record(record);
  }
  const GateResult result = judge("b");
  ASSERT_EQ(result.correlations.size(), 3U);
  const CorrelationPair& shown = result.correlations[2];
  EXPECT_TRUE(shown.within_run);
  EXPECT_FALSE(shown.decides);
  EXPECT_EQ(shown.device, "b:new");
  EXPECT_EQ(shown.other, "a:known");
}

TEST_F(CorrelationGateTest, JsonHoldsTheWholePair) {
  accept_known();
  measure_anchors("anchors", "b:new");
  measure("b", "b:new");
  const core::Json json = to_json(judge("b"));
  ASSERT_EQ(json.at("correlations").size(), 1U);
  const core::Json& pair = json.at("correlations")[0];
  EXPECT_EQ(pair.at("configurations").size(), 60U);
  EXPECT_EQ(pair.at("configurations")[0].at("work_unit"), "samples");
  EXPECT_FALSE(pair.at("levels").empty());
  EXPECT_EQ(pair.at("global").at("groups"), 4);
}

}  // namespace
}  // namespace triptych::judge
