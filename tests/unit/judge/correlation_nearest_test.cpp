// Of several stored devices the nearest decides.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "correlation_fixture.hpp"

namespace triptych::judge {
namespace {

using core::ExitCode;
using testing::HasSubstr;

class NearestDeviceTest : public CorrelationGateTest {
 protected:
  // A device that is faster by a fifth at one technique, which makes all others slow at it.
  static double of_far(const record::Record& record) {
    return record.technique == "raycast_fragment" ? 0.8 : 1;
  }

  // Of one more run of "b:new".
  [[nodiscard]] GateResult judge_new(const Times& times = {}) {
    measure_anchors("x anchors", "b:new");
    measure("x plan", "b:new", times);
    return judge("x plan");
  }

  static const CorrelationPair& by(const GateResult& result, const std::string& other) {
    return *std::ranges::find(result.correlations, other, &CorrelationPair::other);
  }
};

TEST_F(NearestDeviceTest, AFartherDevicesCharacterAdvises) {
  accept_known();
  accept_runs_of("c:far", TimingModel::least_runs, of_far);
  const GateResult result = judge_new();
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_TRUE(by(result, "a:known").decides);
  EXPECT_FALSE(by(result, "c:far").decides);
  ASSERT_TRUE(by(result, "c:far").result.admitted());
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_THAT(
      advice[0].message,
      HasSubstr("beside what decides: slower by c:far; driver 1 (another processor, ρ = 0.9"));
  EXPECT_THAT(advice[0].message, HasSubstr("): technique=raycast_fragment"));
  EXPECT_FALSE(result.in_doubt.contains("b:new")) << "by a device that does not decide";
}

TEST_F(NearestDeviceTest, WhatTheNearestSaysFails) {
  accept_known();
  accept_runs_of("c:far", TimingModel::least_runs, of_far);
  const GateResult result =
      judge_new([](const record::Record& r) { return r.factors.at("data") == "d1" ? 1.25 : 1; });
  EXPECT_EQ(result.exit_code(), ExitCode::regression);
  for (const Finding& slower : with(result, Verdict::regression)) {
    EXPECT_THAT(slower.message, HasSubstr("a:known; driver 1 lets expect"));
    EXPECT_THAT(slower.configuration.empty() ? slower.message : slower.configuration,
                HasSubstr("data=d1"));
  }
}

// Fewer runs than a verdict needs: it would only advise.
TEST_F(NearestDeviceTest, OneThatMayFailDecidesBeforeANearerOne) {
  accept_known(TimingModel::least_runs - 1);
  accept_runs_of("c:far", TimingModel::least_runs, of_far);
  const GateResult result = judge_new();
  EXPECT_FALSE(by(result, "a:known").decides);
  EXPECT_TRUE(by(result, "c:far").decides);
  EXPECT_EQ(result.exit_code(), ExitCode::regression) << text(result);
}

// Nothing is nearer than a device to itself.
TEST_F(NearestDeviceTest, AnAcceptedDeviceIsJudgedByItsOwnHistory) {
  accept_known();
  accept_runs_of("b:new", TimingModel::least_runs);
  const GateResult result = judge_new();
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_TRUE(by(result, "b:new").of_itself);
  EXPECT_TRUE(by(result, "b:new").decides);
  EXPECT_FALSE(by(result, "a:known").decides);
  EXPECT_THAT(text(result), HasSubstr("as its own history lets expect"));
}

TEST_F(NearestDeviceTest, SoItIsWhereAnotherCorrelatesBetter) {
  accept_known();
  int turn = 0;
  accept_runs_of("b:new", TimingModel::least_runs,
                 [&](const record::Record&) { return std::exp(0.08 * std::sin(turn++ % 48)); });
  const GateResult result = judge_new();
  ASSERT_LT(by(result, "b:new").result.rho, by(result, "a:known").result.rho);
  EXPECT_TRUE(by(result, "b:new").decides);
}

// A twentieth on the longest times, which by another device's line its character blurs.
TEST_F(NearestDeviceTest, ByItsOwnHistoryATwentiethOfTheLongestTimesIsFound) {
  accept_known();
  accept_runs_of("b:new", TimingModel::least_runs);
  const GateResult result =
      judge_new([](const record::Record& r) { return r.factors.at("step") == "5" ? 1.05 : 1; });
  const auto longest_by = [&](const std::string& other) {
    return *std::ranges::find(by(result, other).result.levels, "5", &LevelEffect::level);
  };
  ASSERT_TRUE(by(result, "b:new").decides);
  EXPECT_TRUE(longest_by("b:new").slower);
  EXPECT_LT(longest_by("b:new").standard_error, longest_by("a:known").standard_error / 2);
}

TEST_F(NearestDeviceTest, BesideOneThatJudgesARefusedOneIsNoAdvice) {
  accept_known();
  int turn = 0;  // each configuration by a factor of its own, the same in every run
  accept_runs_of("c:unlike", TimingModel::least_runs,
                 [&](const record::Record&) { return std::exp(0.4 * std::sin(turn++ % 48)); });
  const GateResult result = judge_new();
  EXPECT_EQ(result.exit_code(), ExitCode::pass) << text(result);
  EXPECT_EQ(result.findings.size(), 1U) << text(result);
  EXPECT_EQ(by(result, "c:unlike").result.admitted(), false);
}

// One more that cannot judge is no reason to pass.
TEST_F(NearestDeviceTest, BesideOneThatOnlyAdvisesARefusedOneDecidesNothing) {
  accept_known(TimingModel::least_runs - 1);
  EXPECT_EQ(judge_new().exit_code(), ExitCode::cannot_judge);
  int turn = 0;
  accept_runs_of("c:unlike", TimingModel::least_runs,
                 [&](const record::Record&) { return std::exp(0.4 * std::sin(turn++ % 48)); });
  const GateResult result = judge_new();
  EXPECT_EQ(result.exit_code(), ExitCode::cannot_judge) << text(result);
  EXPECT_THAT(result.headline(), HasSubstr("nothing was decided of b:new"));
}

// However many there are.
TEST_F(NearestDeviceTest, WhatOthersSayIsOneLineOfADevice) {
  accept_known();
  accept_runs_of("c:far", TimingModel::least_runs, of_far);
  accept_runs_of("d:far", TimingModel::least_runs, of_far);
  const GateResult result = judge_new();
  const auto advice = with(result, Verdict::advisory);
  ASSERT_EQ(advice.size(), 1U) << text(result);
  EXPECT_THAT(advice[0].message, HasSubstr("slower by c:far"));
  EXPECT_THAT(advice[0].message, HasSubstr("; by d:far"));
}

}  // namespace
}  // namespace triptych::judge
