// Two synthetic devices: what the correlation finds of planted slowdowns, and how often it cries
// wolf. Every rate is counted over seeded trials; a bound leaves what a binomial count exceeds with
// a probability below 10⁻⁴, so that the seed decides nothing.

#include "judge/correlation_model.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <functional>

#include "core/random.hpp"
#include "judge/statistics.hpp"
#include "tests/support/normal.hpp"

namespace triptych::judge {
namespace {

using testing::HasSubstr;

using test::normal;

struct Bench {
  double slope = 0.95;
  double noise = 0.05;           // ε, standard deviation in ln t
  double anchor_scatter = 0.02;  // of anchor techniques' ratios
  double wild = 0;               // share of configurations that differ by a factor e^±0.5
  int anchor_techniques = 5;
  double wild_anchor = 0;  // what the last technique's times scatter by from run to run
  int repeats = 1;         // 48 configurations each
  // What is planted on a configuration, in ln t_B.
  std::function<double(const CorrelationCase&)> planted = [](const CorrelationCase&) {
    return 0.0;
  };

  // 4 data × 3 cameras × 2 techniques × 2 skips, times over a factor of e^3.
  [[nodiscard]] std::vector<CorrelationCase> draw(std::uint64_t seed) const {
    core::Random random(seed);
    std::vector<CorrelationCase> cases;
    for (int i = 0; i < 48 * repeats; ++i) {
      CorrelationCase each;
      each.factors = {{"data", fmt::format("d{}", i % 4)},
                      {"camera", fmt::format("c{}", i / 4 % 3)},
                      {"technique", i / 12 % 2 == 0 ? "raycast" : "fragment"},
                      {"skip", i / 24 % 2 == 0 ? "none" : "bricks"},
                      {"viewport", "192"}};
      each.configuration = fmt::format("n={}", i);
      each.log_time_a = 14 + 3 * random.uniform();
      each.variance_a = 1e-5;
      each.variance_b = 1e-5;
      const double odd = random.uniform() < wild ? (random.uniform() < 0.5 ? -0.5 : 0.5) : 0;
      each.log_time_b = 1 + slope * each.log_time_a + noise * normal(random) + odd + planted(each);
      cases.push_back(each);
    }
    for (int technique = 0; technique < anchor_techniques; ++technique) {
      const double launch_scatter = technique + 1 == anchor_techniques ? wild_anchor : 0;
      const double own = anchor_scatter * normal(random);
      for (int size = 1; size <= 2; ++size) {
        CorrelationCase each;
        each.anchor = true;
        each.factors = {{"technique", fmt::format("anchor_{}", technique)}};
        each.configuration = fmt::format("anchor={},{}", technique, size);
        each.log_time_a = 14.5 + technique * 0.3 + std::log(size);
        each.log_time_b = 1 + slope * each.log_time_a + own + 0.005 * normal(random);
        each.variance_b = launch_scatter * launch_scatter;
        if (launch_scatter > 0) each.log_time_b += launch_scatter * normal(random);
        cases.push_back(each);
      }
    }
    return cases;
  }
};

int count(const Bench& bench, int trials, const std::function<bool(const Correlation&)>& what) {
  int found = 0;
  for (int seed = 1; seed <= trials; ++seed) {
    const Correlation result = correlate(bench.draw(static_cast<std::uint64_t>(seed)));
    found += what(result) ? 1 : 0;
  }
  return found;
}

// The most of `trials` that a true rate of `share` explains; at least, for `least`.
int most(int trials, double share) {
  return static_cast<int>(
      boost::math::quantile(boost::math::complement(boost::math::binomial(trials, share), 1e-4)));
}
int least(int trials, double share) {
  return static_cast<int>(boost::math::quantile(boost::math::binomial(trials, share), 1e-4));
}

bool any_configuration(const Correlation& result) {
  return std::ranges::any_of(result.judgements, &ConfigurationJudgement::slower);
}
bool any_level(const Correlation& result) {
  return std::ranges::any_of(result.levels, &LevelEffect::slower);
}

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

TEST(Correlation, SeesATwentiethOnAFactorLevelAndNamesItFirst) {
  Bench bench{.repeats = 2};
  bench.planted = [](const CorrelationCase& each) {
    return each.factors.at("skip") == "bricks" ? std::log(1.05) : 0;
  };
  // 48 against 48 at ŝ = 5 %: the effect is 4.9 standard errors.
  constexpr int trials = 200;
  const int found = count(bench, trials, [](const Correlation& result) {
    return result.levels.front().slower && result.levels.front().factor == "skip" &&
           result.levels.front().level == "bricks";
  });
  EXPECT_GE(found, least(trials, 0.8));
  EXPECT_LE(count(bench, trials,
                  [](const Correlation& result) {
                    return std::ranges::any_of(result.levels, [](const LevelEffect& level) {
                      return level.slower && level.factor != "skip";
                    });
                  }),
            most(trials, 0.05));
}

TEST(Correlation, ALevelOfLongTimesDoesNotHideInTheSlope) {
  Bench bench{.noise = 0.03, .repeats = 2};
  const auto cases = [&](std::uint64_t seed) {
    auto drawn = bench.draw(seed);
    for (CorrelationCase& each : drawn) {
      if (each.anchor) continue;
      const bool large = each.factors.at("data") == "d3";
      each.log_time_a += large ? 2 : 0;
      each.log_time_b += large ? 2 * bench.slope + std::log(1.05) : 0;
    }
    return drawn;
  };
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Correlation result = correlate(cases(seed));
    found += std::ranges::any_of(result.levels, [](const LevelEffect& level) {
      return level.slower && level.level == "d3";
    });
  }
  EXPECT_GE(found, least(200, 0.6));
}

// The long half of the times is one level, and slower: it tilts the line through all.
TEST(Correlation, ASlowerLevelOfLongTimesTakesNoOtherWithIt) {
  Bench bench{.noise = 0.02, .repeats = 2};
  const auto draw = [&](std::uint64_t seed) {
    auto cases = bench.draw(seed);
    for (CorrelationCase& each : cases) {
      if (each.anchor) continue;
      // Another factor that has to do with the length, but not as much.
      const bool large = each.log_time_a > 15.5;
      each.factors["size"] = large ? "large" : "small";
      if (each.log_time_a > 16.5) each.factors["data"] = "d0";
      each.log_time_b += large ? std::log(1.25) : 0;
    }
    return cases;
  };
  constexpr int trials = 200;
  int named = 0;
  int others = 0;
  for (int seed = 1; seed <= trials; ++seed) {
    const Correlation result = correlate(draw(static_cast<std::uint64_t>(seed)));
    named += result.line_beside == "size=large" && result.levels.front().level == "large" &&
                     result.levels.front().slower
                 ? 1
                 : 0;
    others += std::ranges::any_of(result.levels, [](const LevelEffect& level) {
      return level.slower && level.factor != "size";
    });
    EXPECT_NEAR(result.line.slope, bench.slope, 5 * result.slope_error);
  }
  EXPECT_EQ(named, trials);
  EXPECT_LE(others, most(trials, CorrelationModel::share_of_false_alarms));
}

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
    const double own = bench.anchor_scatter * normal(random);
    for (CorrelationCase& each : cases) each.log_time_b += each.anchor ? 0 : own;
    alarms += correlate(cases).global.slower;
  }
  EXPECT_LE(alarms, most(400, CorrelationModel::false_global_alarms));
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

// Half of all slower by a quarter, on a device that nobody knows.
TEST(Correlation, OneLevelMayStandBesideTheLine) {
  Bench bench{.noise = 0.02};
  for (const char* slower : {"none", "bricks"}) {
    bench.planted = [&](const CorrelationCase& each) {
      return each.factors.at("skip") == slower ? std::log(1.25) : 0;
    };
    const auto cases = bench.draw(6);
    const Correlation result = correlate(cases);
    ASSERT_TRUE(result.admitted()) << fmt::format("{}", fmt::join(result.refusals, "; "));
    EXPECT_EQ(result.line_beside, fmt::format("skip={}", slower));
    EXPECT_LT(result.scale, 0.03);
    EXPECT_NEAR(result.line.slope, bench.slope, 4 * result.slope_error);
    EXPECT_EQ(result.levels.front().level, slower);
    EXPECT_TRUE(result.levels.front().slower);
    EXPECT_NEAR(result.levels.front().effect, std::log(1.25), 4 * 0.02 * 2 / std::sqrt(48));
    EXPECT_EQ(std::ranges::count_if(result.levels, &LevelEffect::slower), 1);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].anchor) continue;
      EXPECT_EQ(result.judgements[i].slower, cases[i].factors.at("skip") == slower);
    }
  }
}

// Where more than half is slower the line is theirs: the level is named, none of them for itself.
TEST(Correlation, TheLineBesideALevelIsOfTheMore) {
  auto cases = Bench{.noise = 0.02}.draw(6);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].anchor) continue;
    const bool large = i < 25;
    cases[i].factors["size"] = large ? "large" : "small";
    cases[i].log_time_b += large ? std::log(1.6) : 0;
  }
  const Correlation result = correlate(cases);
  ASSERT_TRUE(result.admitted());
  EXPECT_THAT(result.line_beside, testing::StartsWith("size="));
  EXPECT_FALSE(any_configuration(result));
  EXPECT_EQ(std::ranges::count_if(result.judgements, &ConfigurationJudgement::faster), 23);
  EXPECT_EQ(result.levels.front().level, "large");
  EXPECT_TRUE(result.levels.front().slower);
}

// Two devices that differ in more than one thing have no line beside any one of them.
TEST(Correlation, UnlikeDevicesHaveNoLineBesideALevel) {
  Bench bench{.noise = 0.02};
  bench.planted = [](const CorrelationCase& each) {
    return (each.factors.at("skip") == "none" ? 0.5 : 0) +
           (each.factors.at("technique") == "raycast" ? 0.4 : 0);
  };
  EXPECT_FALSE(correlate(bench.draw(7)).admitted());
  // A level is in the way, but not all that is.
  bench.noise = 0.085;
  bench.repeats = 4;
  bench.planted = [](const CorrelationCase& each) {
    return each.factors.at("skip") == "none" ? 0.2 : 0;
  };
  EXPECT_LE(count(bench, 30, [](const Correlation& result) { return result.admitted(); }), 3);
  const Bench scattered{.noise = 0.15};
  EXPECT_EQ(
      count(scattered, 200, [](const Correlation& result) { return !result.line_beside.empty(); }),
      0);
}

// The median of two levels of one size, one of them slower, lies where nothing is.
TEST(Correlation, ALevelIsHeldAgainstTwoThatDiffer) {
  Bench bench;
  bench.noise = 0.004;
  bench.repeats = 2;
  bench.planted = [](const CorrelationCase& each) {
    return each.factors.at("camera") == "c1" ? std::log(1.3) : 0.0;
  };
  const Correlation result = correlate(bench.draw(9));
  ASSERT_TRUE(result.admitted());
  ASSERT_FALSE(result.levels.empty());
  EXPECT_EQ(result.levels.front().level, "c1");
  for (const LevelEffect& level : result.levels) {
    EXPECT_TRUE(std::isfinite(level.effect)) << level.level;
    EXPECT_EQ(level.slower, level.level == "c1") << level.level;
  }
}

TEST(Correlation, LevelsOfTheSameConfigurationsAreOne) {
  auto cases = Bench{}.draw(1);
  for (CorrelationCase& each : cases) each.factors["sampler"] = each.factors["technique"];
  const Correlation result = correlate(cases);
  const auto named = std::ranges::count_if(result.levels, [](const LevelEffect& level) {
    return level.factor == "technique" || level.factor == "sampler";
  });
  EXPECT_EQ(named, 2);
  EXPECT_TRUE(std::ranges::any_of(result.levels,
                                  [](const LevelEffect& level) { return !level.aliases.empty(); }));
}

TEST(Correlation, SmallestEffectsAreThoseOfTheFormula) {
  const Correlation result = correlate(Bench{.repeats = 8}.draw(2));
  EXPECT_NEAR(result.smallest_effect / result.scale, 4.9, 0.2);  // t for 0.02/384, and 0.84
  for (const LevelEffect& level : result.levels) {
    EXPECT_GT(level.smallest_effect, 3 * level.standard_error);
    EXPECT_LT(level.smallest_effect, 5 * level.standard_error);
  }
}

TEST(AdjustedPValues, DecideAsTheProcedureDoes) {
  const std::vector<double> p{0.001, 0.8, 0.012, 0.02, 0.04, 0.5};
  const auto adjusted = benjamini_hochberg_adjusted(p);
  for (const double q : {0.005, 0.01, 0.03, 0.05, 0.07, 0.9}) {
    const auto rejected = benjamini_hochberg(p, q);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(adjusted[i] <= q, rejected[i]) << q;
  }
}

}  // namespace
}  // namespace triptych::judge
