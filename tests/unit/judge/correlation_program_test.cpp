#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "judge/correlation/program.hpp"
#include "judge/statistics/statistics.hpp"
#include "tests/support/normal.hpp"
#include "tests/unit/judge/correlation_bench.hpp"

namespace triptych::judge {
namespace {

using Bench = CorrelationBench;

TEST(Correlation, OnlyAnchorsSeeThatAllIsSlower) {
  Bench bench;
  bench.planted = [](const CorrelationCase&) { return std::log(1.15); };
  constexpr int trials = 200;
  EXPECT_GE(count(bench, trials, [](const Correlation& result) { return result.global.slower; }),
            least(trials, 0.7));
  EXPECT_LE(count(bench, trials, any_configuration),
            most(trials, CorrelationModel::share_of_false_alarms));
  bench.planted = [](const CorrelationCase&) { return std::log(1.10); };
  bench.anchor_scatter = 0.01;
  const auto told = [](const Correlation& result) {
    return result.global.p <= CorrelationModel::false_global_alarms;
  };
  EXPECT_GE(count(bench, trials, told), least(trials, 0.9));
}

// One technique's times are a factor of three apart from run to run, and it is known to be so.
TEST(Correlation, AWildAnchorSaysLittle) {
  Bench bench{.wild_anchor = 0.5};
  constexpr int trials = 300;
  const auto slower = [](const Correlation& result) { return result.global.slower; };
  EXPECT_LE(count(bench, trials, slower), most(trials, CorrelationModel::false_global_alarms));
  bench.planted = [](const CorrelationCase&) { return std::log(1.2); };
  EXPECT_GE(count(bench, trials, slower), least(trials, 0.8));
}

TEST(Correlation, ASlowerDeviceIsNoSlowerProgram) {
  const Bench bench;
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    auto cases = bench.draw(seed);
    for (CorrelationCase& each : cases) each.log_time_b += std::log(3);
    alarms += correlate(cases).global.slower;
  }
  EXPECT_LE(alarms, most(200, CorrelationModel::false_global_alarms));
}

// The ratio of two devices differs from resource to resource, and a program is one more mix of
// them.
TEST(Correlation, AProgramIsOneMoreMixOfResources) {
  const Bench bench{.anchor_scatter = 0.08};
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    auto cases = bench.draw(seed);
    core::Random random(seed + 1000);
    const double own = bench.anchor_scatter * test::normal(random);
    for (CorrelationCase& each : cases) each.log_time_b += each.anchor ? 0 : own;
    alarms += correlate(cases).global.slower;
  }
  EXPECT_LE(alarms, most(400, CorrelationModel::false_global_alarms));
}

// On a device that was accepted: what its times were then, and what all of today's share.
struct KnownDevice {
  CorrelationBench bench{.anchor_scatter = 0.2};  // a device unlike the other
  double noise = 0.01;                            // of today's times, standard deviation in ln t
  double slower = 1;                              // today's program
  double minute = 0;  // standard deviation of what a slow minute adds to the whole program
  double device = 1;  // slower today, anchors and all

  [[nodiscard]] std::vector<CorrelationCase> draw(std::uint64_t seed) const {
    auto cases = bench.draw(seed);
    core::Random random(seed + 1000);
    const double common = minute * test::normal(random);
    for (CorrelationCase& each : cases) {
      each.known_log_time_b = each.log_time_b;
      each.log_time_b += std::log(device) + noise * test::normal(random);
      each.log_time_b += each.anchor ? 0 : std::log(slower) + common;
    }
    return cases;
  }
  [[nodiscard]] KnownVariance beside_anchors() const {
    return {noise * noise / 10 + minute * minute, 20};
  }
  [[nodiscard]] int count_slower(int trials) const {
    int slower_ones = 0;
    for (int seed = 1; seed <= trials; ++seed) {
      const GlobalShift global =
          correlate(draw(static_cast<std::uint64_t>(seed)), beside_anchors()).global;
      EXPECT_TRUE(global.since_acceptance);
      slower_ones += global.slower ? 1 : 0;
    }
    return slower_ones;
  }
};

TEST(Correlation, WhatChangedSinceAcceptanceHasNoCharacterInIt) {
  constexpr int trials = 200;
  EXPECT_GE((KnownDevice{.slower = 1.10}.count_slower(trials)), least(trials, 0.95));
  EXPECT_LE((KnownDevice{.device = 1.3}.count_slower(trials)),
            most(trials, CorrelationModel::false_global_alarms));
  // The same without what was known.
  auto cases = KnownDevice{.slower = 1.10}.draw(1);
  for (CorrelationCase& each : cases) each.known_log_time_b.reset();
  const GlobalShift unknown = correlate(cases, KnownDevice{}.beside_anchors()).global;
  EXPECT_FALSE(unknown.since_acceptance);
  EXPECT_FALSE(unknown.slower);
  EXPECT_GT(unknown.smallest_effect, std::log(1.5));
}

// What is common to all configurations is not less for being seen 48 times.
TEST(Correlation, ASlowMinuteOfAllIsNoSlowerProgram) {
  constexpr int trials = 400;
  EXPECT_LE((KnownDevice{.minute = 0.05}.count_slower(trials)),
            most(trials, CorrelationModel::false_global_alarms));
}

// Today one of ten anchors takes three times as long.
TEST(Correlation, AWildAnchorDoesNotHideWhatChanged) {
  auto cases = KnownDevice{.slower = 1.10}.draw(1);
  cases.back().log_time_b += std::log(3);
  const GlobalShift global = correlate(cases, KnownDevice{}.beside_anchors()).global;
  EXPECT_TRUE(global.slower);
  EXPECT_NEAR(global.delta, std::log(1.10) - 0.0067, 0.01);  // the quartile of 1 % of noise
}

// One level of two is the slower one, however much: that is not the program as a whole.
TEST(Correlation, HalfOfTheProgramIsNotTheWhole) {
  for (const double slower : {1.08, 1.25, 1.5}) {
    auto cases = KnownDevice{}.draw(3);
    for (CorrelationCase& each : cases) {
      const bool inside = !each.anchor && each.factors.at("skip") == "none";
      each.log_time_b += inside ? std::log(slower) : 0;
    }
    const Correlation result = correlate(cases, KnownDevice{}.beside_anchors());
    ASSERT_TRUE(result.admitted()) << slower;
    EXPECT_TRUE(result.global.since_acceptance);
    EXPECT_EQ(result.levels.front().level, "none") << slower;
    EXPECT_FALSE(result.global.slower) << slower << ' ' << result.global.delta;
  }
}

// No stored run says how far the program and the anchors are apart by chance: the anchors' line
// judges, but what stood when the device was accepted is no news.
TEST(Correlation, WhatAnAcceptedProgramLiesAboveTheAnchorsByIsItsCharacter) {
  Bench bench{.anchor_scatter = 0.01};
  bench.planted = [](const CorrelationCase&) { return std::log(1.25); };
  auto cases = bench.draw(1);
  EXPECT_TRUE(correlate(cases).global.slower);
  for (CorrelationCase& each : cases) each.known_log_time_b = each.log_time_b;
  EXPECT_FALSE(correlate(cases).global.slower);
  EXPECT_FALSE(correlate(cases).global.suspected);
  for (CorrelationCase& each : cases) {
    if (!each.anchor) *each.known_log_time_b -= std::log(1.15);
  }
  EXPECT_TRUE(correlate(cases).global.slower);
}

// BCG vaccine trials (Colditz et al. 1994), ln relative risk and its variance, rounded to four
// digits as they are often printed: R's metafor has τ² = 0.318, −0.715 ± 0.181 by Paule and Mandel;
// the digits beyond are of a bisection in another language.
TEST(RandomEffects, GivesThePublishedValues) {
  const std::vector<KnownEffect> trials{
      {-0.8893, 0.3256}, {-1.5854, 0.1946}, {-1.3481, 0.4154}, {-1.4416, 0.0200}, {-0.2175, 0.0512},
      {-0.7861, 0.0069}, {-1.6209, 0.2230}, {0.0120, 0.0040},  {-0.4694, 0.0564}, {-1.3713, 0.0730},
      {-0.3394, 0.0124}, {0.4459, 0.5325},  {-0.0173, 0.0714}};
  const RandomEffects result = random_effects(trials);
  EXPECT_NEAR(result.variance, 0.3180824399, 1e-9);
  EXPECT_NEAR(result.centre, -0.7149703054, 1e-9);
  EXPECT_NEAR(std::sqrt(result.centre_variance), 0.1808945334, 1e-9);
}

TEST(RandomEffects, OfValuesWithoutErrorsIsTheirMeanAndVariance) {
  const std::vector<double> values{0.3, -0.1, 0.4, 0.05, 0.2};
  std::vector<KnownEffect> effects;
  for (const double value : values) effects.push_back({value, 0});
  const RandomEffects result = random_effects(effects);
  const double variance = sample_variance(values);
  EXPECT_NEAR(result.variance, variance, 1e-9 * variance);
  EXPECT_NEAR(result.centre, mean(values), 1e-12);
  EXPECT_NEAR(result.centre_variance, variance / 5, 1e-9 * variance);
  EXPECT_NEAR(result.degrees, 4, 1e-9);
}

// A value that is hardly known counts for nothing, as if it were not there.
TEST(RandomEffects, LeaveOutWhatIsHardlyKnown) {
  std::vector<KnownEffect> effects{{0.3, 0}, {-0.1, 0}, {0.4, 0}, {0.05, 0}};
  const RandomEffects without = random_effects(effects);
  effects.push_back({100, 1e9});
  const RandomEffects with = random_effects(effects);
  EXPECT_NEAR(with.centre, without.centre, 1e-6);
  EXPECT_NEAR(with.degrees, without.degrees, 1e-6);
  // Σw(y − ȳ)² has one summand more, of which 1 is expected and 10⁻⁵ is there.
  EXPECT_LT(with.variance, without.variance);
}

TEST(RandomEffects, AlikeValuesHaveNoZeroOverZero) {
  const std::vector<KnownEffect> alike{{0.5, 0}, {0.5, 0}, {0.5, 0.1}};
  const RandomEffects result = random_effects(alike);
  EXPECT_DOUBLE_EQ(result.centre, 0.5);
  EXPECT_GE(result.degrees, 1);
  EXPECT_TRUE(std::isfinite(result.centre_variance));
}

// Five values with s = 3 %, of which one is known to 40 %: its own deviation is no measure of the
// others', and the next value lies within Student's t of the centre.
TEST(RandomEffects, PredictTheNextOne) {
  core::Random random(5);
  constexpr int trials = 4000;
  constexpr double share = 0.05;
  int beyond = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<KnownEffect> effects;
    for (int i = 0; i < 5; ++i) {
      const double own = i == 0 ? 0.4 : 0;
      effects.push_back({std::hypot(0.03, own) * test::normal(random), own * own});
    }
    const RandomEffects result = random_effects(effects);
    const double error = std::sqrt(result.variance + result.centre_variance);
    const double t = (0.03 * test::normal(random) - result.centre) / error;
    beyond += student_t_upper_tail(t, result.degrees) <= share ? 1 : 0;
  }
  EXPECT_NEAR(beyond, share * trials, 4 * std::sqrt(share * trials));
}

}  // namespace
}  // namespace triptych::judge
