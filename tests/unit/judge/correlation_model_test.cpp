// What the correlation finds of planted slowdowns, and how often it cries wolf.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "judge/correlation/model.hpp"
#include "judge/statistics/statistics.hpp"
#include "tests/unit/judge/correlation_bench.hpp"

namespace triptych::judge {
namespace {

using testing::HasSubstr;

using Bench = CorrelationBench;

// Its times scatter by a tenth from run to run, by the word of very many runs or of three.
TEST(Correlation, AScatterThatFewRunsToldLeavesMoreRoomForChance) {
  auto cases = Bench{.noise = 0.01}.draw(1);
  cases[0].log_time_b += 0.5;
  cases[0].variance_b = 0.01;
  const ConfigurationJudgement known = correlate(cases).judgements[0];
  EXPECT_TRUE(known.slower);
  cases[0].degrees_b = 2;
  const Correlation result = correlate(cases);
  const ConfigurationJudgement& guessed = result.judgements[0];
  EXPECT_DOUBLE_EQ(guessed.z, known.z);
  EXPECT_FALSE(guessed.slower);
  // (Σu)²/Σ(u²/ν) twice, s_A² known beyond doubt: of s², and of its excess and the line's ŝ².
  const double of_line = result.scale * result.scale * (1 + guessed.leverage);
  const double own = cases[0].variance_a + cases[0].variance_b;
  const double more = own - (cases[1].variance_a + cases[1].variance_b);
  const double own_degrees = own * own / (0.01 * 0.01 / 2);
  const double sum = of_line + more;
  const double degrees = sum * sum / (of_line * of_line / 46 + more * more / own_degrees);
  EXPECT_NEAR(guessed.z, guessed.residual / std::sqrt(sum), 1e-9);
  EXPECT_NEAR(guessed.p, student_t_upper_tail(guessed.z, degrees), 1e-9);
}

TEST(Correlation, GivesTheLineBack) {
  const Bench bench{.wild = 0.1};
  std::vector<double> slopes;
  std::vector<double> scales;
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Correlation result = correlate(bench.draw(seed));
    slopes.push_back(result.line.slope);
    errors.push_back(result.slope_error);
    scales.push_back(result.scale);
  }
  // Means of 200: three standard errors.
  EXPECT_NEAR(mean(slopes), 0.95, 3 * std::sqrt(sample_variance(slopes) / 200));
  EXPECT_NEAR(mean(errors) / std::sqrt(sample_variance(slopes)), 1, 0.2);
  // A tenth wild makes an S-scale larger by less than a fifth (Maronna et al. 2019, 3.2.3).
  EXPECT_GT(mean(scales), 0.05);
  EXPECT_LT(mean(scales), 0.06);
}

TEST(Correlation, ExpectedFalseAlarmsAreRare) {
  const Bench bench;
  constexpr int trials = 400;
  EXPECT_LE(count(bench, trials, any_configuration),
            most(trials, CorrelationModel::share_of_false_alarms));
  EXPECT_LE(count(bench, trials, any_level), most(trials, CorrelationModel::share_of_false_alarms));
  EXPECT_LE(count(bench, trials, [](const Correlation& result) { return result.global.slower; }),
            most(trials, CorrelationModel::false_global_alarms));
}

TEST(Correlation, SeesAQuarterOnOneConfiguration) {
  Bench bench;
  bench.planted = [](const CorrelationCase& each) {
    return each.configuration == "n=17" ? std::log(1.25) : 0;
  };
  // At ŝ = 5 % ln 1.25 is 4.46 ŝ, the smallest effect for a probability of 0.8 about 4.3 ŝ.
  constexpr int trials = 200;
  const int found =
      count(bench, trials, [](const Correlation& result) { return result.judgements[17].slower; });
  EXPECT_GE(found, least(trials, 0.8));
  bench.noise = 0.03;
  const int finer = count(bench, trials, [](const Correlation& result) {
    return result.judgements[17].slower &&
           std::ranges::count_if(result.judgements, &ConfigurationJudgement::slower) == 1;
  });
  EXPECT_GE(finer, least(trials, 0.95));
}

// The residuals' scale is made of the times' own scatter: each told of it loses nothing by that.
TEST(Correlation, WhatAllTimesScatterByIsNotCountedTwice) {
  auto cases = Bench{}.draw(3);
  const double z = correlate(cases).judgements[17].z;
  for (CorrelationCase& each : cases) each.variance_b = 0.05 * 0.05;
  EXPECT_DOUBLE_EQ(correlate(cases).judgements[17].z, z);
  cases[17].variance_b *= 4;
  EXPECT_LT(std::abs(correlate(cases).judgements[17].z), 0.7 * std::abs(z));
}

TEST(Correlation, WhatStoodWhenTheDeviceWasAcceptedIsNoNews) {
  Bench bench{.noise = 0.03};
  bench.planted = [](const CorrelationCase& each) {
    return each.configuration == "n=17" ? std::log(1.5) : 0;
  };
  auto cases = bench.draw(1);
  for (CorrelationCase& each : cases) each.known_log_time_b = each.log_time_b - 0.01;
  EXPECT_TRUE(correlate(cases).judgements[17].slower);
  EXPECT_TRUE(correlate(cases).judgements[17].standing);
  // Nor is it on a device that became slower as a whole.
  for (CorrelationCase& each : cases) each.log_time_b += std::log(1.25);
  EXPECT_TRUE(correlate(cases).judgements[17].standing);
  cases[17].known_log_time_b = cases[17].log_time_b - std::log(1.25 * 1.5);
  EXPECT_FALSE(correlate(cases).judgements[17].standing);
}

TEST(Correlation, RefusesWithEveryReasonAndItsNumber) {
  auto cases = Bench{.slope = 1.5, .noise = 0.5, .anchor_techniques = 2}.draw(3);
  cases.erase(cases.begin(), cases.begin() + 20);
  const Correlation result = correlate(cases);
  EXPECT_FALSE(result.admitted());
  const std::string reasons = fmt::format("{}", fmt::join(result.refusals, "; "));
  EXPECT_THAT(reasons, HasSubstr("28 configurations with like clocks, 30 are needed"));
  EXPECT_THAT(reasons, HasSubstr("4 anchors, 6 are needed"));
  EXPECT_THAT(reasons, HasSubstr("the correlation of ln t is 0."));
  EXPECT_THAT(reasons, HasSubstr("the slope is 1."));
  EXPECT_THAT(reasons, HasSubstr("the residuals scatter by 0."));
  EXPECT_TRUE(result.levels.empty());
  EXPECT_FALSE(any_configuration(result));
}

TEST(Correlation, RefusesNothingAtAll) {
  const Correlation result = correlate({});
  EXPECT_EQ(result.refusals.size(), 2U);
}

TEST(Correlation, OneConfigurationInManyStandsOutByItsShare) {
  Bench bench{.noise = 0.01};
  bench.planted = [](const CorrelationCase& each) {
    return each.configuration == "n=5" ? std::log(1.3) : 0;
  };
  const Correlation result = correlate(bench.draw(9));
  EXPECT_GT(result.judgements[5].share, 0.8);
  EXPECT_LT(result.levels.front().share, result.judgements[5].share);
}

// Half of all slower by half leaves no line; a device that was accepted still has its own.
TEST(Correlation, WhatFollowsNoLineIsHeldAgainstTheAcceptedOne) {
  Bench bench{.noise = 0.02};
  auto cases = bench.draw(4);
  for (CorrelationCase& each : cases) {
    each.known_log_time_b = each.log_time_b;
    // The device is slower by a fifth today, and the program in half of its configurations by half.
    each.log_time_b += std::log(1.2);
    if (!each.anchor && each.factors.at("skip") == "none") each.log_time_b += std::log(1.5);
  }
  const Correlation result = correlate(cases);
  ASSERT_TRUE(result.admitted()) << fmt::format("{}", fmt::join(result.refusals, "; "));
  EXPECT_TRUE(result.line_of_acceptance);
  EXPECT_LT(result.scale, 0.03);
  ASSERT_FALSE(result.levels.empty());
  EXPECT_EQ(result.levels.front().level, "none");
  EXPECT_TRUE(result.levels.front().slower);
  EXPECT_NEAR(result.levels.front().effect, std::log(1.5), 0.02);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].anchor) continue;
    EXPECT_EQ(result.judgements[i].slower, cases[i].factors.at("skip") == "none");
    EXPECT_FALSE(result.judgements[i].standing);
  }
  cases.front().known_log_time_b.reset();
  const Correlation beside = correlate(cases);
  EXPECT_FALSE(beside.line_of_acceptance);
  EXPECT_EQ(beside.line_beside, "skip=none");
}

// Every second time is longer by half: the program's doing, unless times are known to scatter so.
TEST(Correlation, AnAcceptedLineIsNoneForARunThatScattersMore) {
  core::Random random(7);
  auto cases = Bench{.noise = 0.02}.draw(4);
  for (CorrelationCase& each : cases) {
    each.known_log_time_b = each.log_time_b;
    if (!each.anchor && random.uniform() < 0.5) each.log_time_b += std::log(1.5);
  }
  const Correlation calm = correlate(cases);
  EXPECT_TRUE(calm.line_of_acceptance);
  EXPECT_TRUE(any_configuration(calm));
  for (CorrelationCase& each : cases) each.variance_b = 0.2 * 0.2;
  const Correlation noisy = correlate(cases);
  EXPECT_FALSE(noisy.line_of_acceptance);
  EXPECT_TRUE(noisy.refused_for_scatter());
}

TEST(Correlation, SmallestEffectsAreThoseOfTheFormula) {
  const Correlation result = correlate(Bench{.repeats = 8}.draw(2));
  EXPECT_NEAR(result.smallest_effect / result.scale, 4.9, 0.2);  // t for 0.02/384, and 0.84
  ASSERT_FALSE(result.levels.empty());
  for (const LevelEffect& level : result.levels) {
    EXPECT_GT(level.smallest_effect, 3 * level.standard_error);
    EXPECT_LT(level.smallest_effect, 5 * level.standard_error);
  }
}

}  // namespace
}  // namespace triptych::judge
