// Rates and what is asked of them.

#include "judge/evaluation/evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/random.hpp"
#include "judge/evaluation/compare.hpp"

namespace triptych::judge {
namespace {

struct Published {
  std::size_t hits, trials;
  double low, high;
};

// Tables of exact 95 % limits (such as Diem's in Documenta Geigy).
TEST(ClopperPearson, PublishedLimits) {
  for (const Published& each : {Published{0, 10, 0, 0.3085},
                                {5, 10, 0.1871, 0.8129},
                                {10, 100, 0.0490, 0.1762},
                                {10, 10, 0.6915, 1}}) {
    const Interval interval = clopper_pearson(each.hits, each.trials);
    EXPECT_NEAR(interval.low, each.low, 5e-5) << each.hits << "/" << each.trials;
    EXPECT_NEAR(interval.high, each.high, 5e-5) << each.hits << "/" << each.trials;
  }
}

TEST(ClopperPearson, NothingTriedSaysNothing) {
  const Interval interval = clopper_pearson(0, 0);
  EXPECT_EQ(interval.low, 0);
  EXPECT_EQ(interval.high, 1);
  EXPECT_TRUE(std::isnan(Rate{}.share()));
}

// The limits are where the binomial tails are 2.5 %: P(X ≥ 3 | low) and P(X ≤ 3 | high) for 7.
TEST(ClopperPearson, TheTailsAreAFortieth) {
  const auto binomial = [](int k, double p) {
    return std::tgamma(8) / std::tgamma(k + 1) / std::tgamma(8 - k) * std::pow(p, k) *
           std::pow(1 - p, 7 - k);
  };
  const Interval interval = clopper_pearson(3, 7);
  double above = 0;
  double below = 0;
  for (int k = 3; k <= 7; ++k) above += binomial(k, interval.low);
  for (int k = 0; k <= 3; ++k) below += binomial(k, interval.high);
  EXPECT_NEAR(above, 0.025, 1e-9);
  EXPECT_NEAR(below, 0.025, 1e-9);
}

TEST(Evaluation, TheSmallestFoundHasNoMissAboveIt) {
  Tallies tallies;
  TrialKind kind{"compare", "p", "d", Spread::configuration};
  const auto add = [&](double percent, std::size_t hits) {
    kind.percent = percent;
    tallies[kind].detected = {hits, 20};
  };
  add(1, 20);  // by luck: 2 % was missed
  add(2, 10);
  add(3, 19);
  add(5, 20);
  kind.percent = 0;
  EXPECT_EQ(smallest_found(tallies).at(kind), 3);
  add(5, 0);
  kind.percent = 0;
  EXPECT_EQ(smallest_found(tallies).at(kind), std::nullopt);
}

Aim aim_of(const Tallies& tallies, std::string_view text) {
  for (Aim& aim : aims(tallies)) {
    if (aim.text == text) return std::move(aim);
  }
  ADD_FAILURE() << "no aim " << text;
  return {};
}

TEST(Evaluation, AimsAreMetByTheRate) {
  Tallies tallies;
  tallies[{"compare", "p", "d", Spread::configuration, 3}].to_be_caught = {19, 20};
  tallies[{"compare", "p", "d", Spread::none}].false_alarms = {1, 20};
  tallies[{"history", "p", "d", Spread::global, 10}].detected = {17, 20};
  EXPECT_EQ(aim_of(tallies, "compare: a configuration that is slower by 3 % found").met(), true);
  EXPECT_EQ(aim_of(tallies, "compare: A/A runs with a false alarm").met(), false);
  EXPECT_EQ(aim_of(tallies, "history: 3 % of one configuration found").met(), std::nullopt);
  EXPECT_EQ(aim_of(tallies, "history: 10 % of everything found").met(), false);
}

// A pair that is refused has nothing to find, but to be refused.
TEST(Evaluation, OfTheCorrelationOnlyPairsThatJudgeAreAsked) {
  Tallies tallies;
  const std::string method = "correlation, new device";
  const auto add = [&](const char* subject, std::size_t refused, std::size_t found) {
    tallies[{method, "p", subject, Spread::none}].undecided = {refused, 480};
    tallies[{method, "p", subject, Spread::configuration, 25}].to_be_caught = {found, 40};
    tallies[{method, "p", subject, Spread::scrambled}].detected = {8, 8};
  };
  add("alike", 96, 39);
  add("unlike", 240, 0);
  const JudgingPair alike{method, "p", "alike"};
  EXPECT_EQ(judging_pairs(tallies), std::set{alike});
  const Rate found =
      aim_of(tallies, "correlation: a configuration that is slower by 25 % found").rate;
  EXPECT_EQ(found.hits, 39U);
  EXPECT_EQ(found.trials, 40U);
  EXPECT_EQ(aim_of(tallies, "correlation: uncorrelated pairs refused").rate.trials, 16U);
}

TEST(Evaluation, WhatTheNearestSaysIsAskedForItself) {
  Tallies tallies;
  const std::string nearest(by_the_nearest);
  tallies[{nearest, "p", "device", Spread::none}].undecided = {0, 480};
  Tally& planted = tallies[{nearest, "p", "device", Spread::configuration, 25}];
  planted.false_discoveries = {5, 10};
  planted.to_be_caught = {9, 10};
  const auto trials = [&](const char* name) { return aim_of(tallies, name).rate.trials; };
  EXPECT_EQ(trials("correlation: false among the discoveries, new device by the nearest of all "
                   "others"),
            10U);
  EXPECT_EQ(trials("correlation: false among the discoveries, new device"), 0U);
  EXPECT_EQ(trials("correlation: a configuration that is slower by 25 % found"), 0U);
}

TEST(Evaluation, AShuffleIsAnOrder) {
  core::Random random(5);
  const auto order = shuffled(100, random);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 100U);
  EXPECT_NE(order, shuffled(100, random));
}

// Six configurations whose launches differ by `between`, blocks by `within`.
std::vector<BlockSeries> pool(double between, double within) {
  core::Random random(3);
  const auto scatter = [&] { return random.uniform(-1, 1) + random.uniform(-1, 1); };
  std::vector<BlockSeries> result;
  for (int configuration = 0; configuration < 6; ++configuration) {
    for (const double percent : {0.0, 1.0, 3.0, 5.0}) {
      for (int launch = 1; launch <= 8; ++launch) {
        BlockSeries series{.plan = "p",
                           .configuration = "c" + std::to_string(configuration),
                           .factors = {{"view", configuration < 3 ? "near" : "far"}},
                           .device = "d",
                           .percent = percent,
                           .launch = launch,
                           .seconds = 48,
                           .differences = {}};
        const double centre = std::log1p(percent / 100) + between * scatter();
        for (int i = 0; i < 48; ++i) series.differences.push_back(centre + within * scatter());
        result.push_back(std::move(series));
      }
    }
  }
  return result;
}

Tally of(const Tallies& tallies, Spread spread, double percent = 0) {
  return tallies.at({"compare", "p", "d", spread, percent});
}

TEST(EvaluateComparison, FindsWhatIsPlantedAndNothingElse) {
  const Tallies tallies = evaluate_comparison(pool(0.002, 0.005), 50, 1);
  EXPECT_EQ(of(tallies, Spread::none).false_alarms.hits, 0U);
  EXPECT_EQ(of(tallies, Spread::none).false_alarms.trials, 50U);
  EXPECT_EQ(of(tallies, Spread::none).undecided.hits, 0U);
  EXPECT_EQ(of(tallies, Spread::none).detected.trials, 0U);
  for (const Spread spread : {Spread::configuration, Spread::level, Spread::global}) {
    EXPECT_EQ(of(tallies, spread, 5).detected.hits, 50U) << name_of(spread);
    EXPECT_EQ(of(tallies, spread, 5).false_discoveries.hits, 0U) << name_of(spread);
  }
  EXPECT_EQ(of(tallies, Spread::level, 5).found.trials, 150U);
  // What is tolerated is no alarm.
  EXPECT_EQ(of(tallies, Spread::configuration, 1).detected.hits, 0U);
}

// Half of the configurations cost less than was planted: what lies between tolerated and caught may
// be called either way.
TEST(EvaluateComparison, CountsByWhatItReallyCost) {
  std::vector<BlockSeries> series = pool(0.002, 0.005);
  for (BlockSeries& each : series) {
    if (each.percent != 3) continue;
    const double more = each.configuration < "c3" ? 0.01 : -0.012;
    for (double& difference : each.differences) difference += more;
  }
  const Tallies tallies = evaluate_comparison(series, 200, 1);
  const Tally tally = of(tallies, Spread::configuration, 3);
  EXPECT_GT(tally.to_be_caught.trials, 60U);
  EXPECT_LT(tally.to_be_caught.trials, 140U);
  EXPECT_EQ(tally.to_be_caught.hits, tally.to_be_caught.trials);
  ASSERT_EQ(tally.found_by_cost.size(), 2U);
  EXPECT_EQ(tally.found_by_cost.at(3).trials, tally.to_be_caught.trials);
  EXPECT_EQ(tally.found_by_cost.at(1).trials, 200 - tally.to_be_caught.trials);
  EXPECT_EQ(tally.found_by_cost.at(1).hits + tally.to_be_caught.hits, tally.found.hits);
  EXPECT_EQ(found_by_cost(tallies).at(1).trials,
            of(tallies, Spread::configuration, 1).found_by_cost.at(1).trials +
                tally.found_by_cost.at(1).trials);
}

TEST(EvaluateComparison, NoiseMakesItSilentNotWrong) {
  const Tallies tallies = evaluate_comparison(pool(0.002, 0.3), 50, 1);
  EXPECT_EQ(of(tallies, Spread::none).undecided.share(), 1);
  EXPECT_EQ(of(tallies, Spread::configuration, 3).detected.hits, 0U);
  EXPECT_EQ(of(tallies, Spread::none).false_alarms.hits, 0U);
}

// Launches that disagree suspect much at first; fresh ones are what keeps that from being said.
TEST(EvaluateComparison, LaunchesThatDisagreeAreNotBelieved) {
  const Tallies tallies = evaluate_comparison(pool(0.02, 0.002), 200, 1);
  EXPECT_LE(of(tallies, Spread::none).false_alarms.share(), 0.15);
}

TEST(EvaluateComparison, SecondsAreThoseOfTheBlocksUsed) {
  const Tally tally = of(evaluate_comparison(pool(0.0005, 0.001), 20, 1), Spread::none);
  EXPECT_DOUBLE_EQ(tally.seconds / static_cast<double>(tally.configurations), 12);
}

TEST(EvaluateComparison, TheSameSeedGivesTheSameCounts) {
  const auto series = pool(0.01, 0.01);
  const auto hits = [&](std::uint64_t seed) {
    std::vector<std::size_t> result;
    for (const auto& [kind, tally] : evaluate_comparison(series, 40, seed)) {
      result.push_back(tally.detected.hits + 1000 * tally.undecided.hits);
    }
    return result;
  };
  EXPECT_EQ(hits(1), hits(1));
  EXPECT_NE(hits(1), hits(2));
}

TEST(EvaluateComparison, WhatWasNotMeasuredIsNotTried) {
  std::vector<BlockSeries> series = pool(0.002, 0.005);
  std::erase_if(series, [](const BlockSeries& each) { return each.percent == 0; });
  const auto tried = evaluate_comparison(series, 5, 1);
  ASSERT_FALSE(tried.empty());
  for (const auto& [kind, tally] : tried) {
    EXPECT_EQ(kind.spread, Spread::global);  // alone needs no unplanted launch
  }
  EXPECT_TRUE(evaluate_comparison({}, 5, 1).empty());
}

}  // namespace
}  // namespace triptych::judge
