// What the correlation finds of slower factor levels, and whom it names with them.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "core/random.hpp"
#include "judge/correlation/model.hpp"
#include "tests/support/normal.hpp"
#include "tests/unit/judge/correlation_bench.hpp"

namespace triptych::judge {
namespace {

using Bench = CorrelationBench;

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

// Half of the configurations, the longer: by its own history a device is judged at a slope of 1.
TEST(Correlation, OfItselfTheLongerHalfSlowerByATwelfthIsAllThatIsNamed) {
  Bench bench{.slope = 1, .noise = 0.015};
  const auto named = [&](std::uint64_t seed, bool of_itself) {
    auto drawn = bench.draw(seed);
    for (CorrelationCase& each : drawn) {
      if (each.anchor) continue;
      const bool longer = each.factors.at("skip") == "bricks";
      // Times that little but this level spreads.
      const double moved = (longer ? 17 : 14) - 0.9 * (each.log_time_a - 14) - 14;
      each.log_time_a += moved;
      each.log_time_b += moved + (longer ? std::log(13.0 / 12) : 0);
    }
    std::set<std::string> levels;
    for (const LevelEffect& level : correlate(drawn, {0, 0}, of_itself).levels) {
      if (level.slower) levels.insert(level.level);
    }
    return levels;
  };
  const std::set<std::string> planted{"bricks"};
  int found = 0;
  int beside_a_slope = 0;
  constexpr int trials = 50;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    found += named(seed, true) == planted ? 1 : 0;
    beside_a_slope += named(seed, false) == planted ? 1 : 0;
  }
  EXPECT_GE(found, least(trials, 0.95));
  EXPECT_LT(beside_a_slope, found);
}

// A calm run beside stored ones that had slow minutes: the next run may have such minutes as well.
TEST(Correlation, OfItselfNoLineScattersLessThanItsStoredRuns) {
  auto cases = Bench{.slope = 1, .noise = 0.01}.draw(1);
  for (CorrelationCase& each : cases) {
    each.known_log_time_b = each.log_time_a;
    if (!each.anchor) each.variance_b = 0.12 * 0.12;
  }
  const Correlation result = correlate(cases, {0, 0}, true);
  EXPECT_NEAR(result.scale, 0.12, 1e-3);
  EXPECT_FALSE(result.line_of_acceptance);
  ASSERT_EQ(result.refusals.size(), 1U);
  EXPECT_THAT(result.refusals[0], testing::HasSubstr("the residuals scatter by 0.120"));
  EXPECT_TRUE(correlate(cases).admitted());
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

// Times of a narrow range: what the line explains of them falls below what may judge as soon as
// half of them are slower. Of itself it need not; by another device that may be what they are
// unlike in.
TEST(Correlation, OfItselfTimesOfANarrowRangeDoNotHideASlowerHalf) {
  auto cases = Bench{.slope = 1, .noise = 0.02}.draw(6);
  for (CorrelationCase& each : cases) {
    if (each.anchor) continue;
    const double narrower = (each.log_time_a - 14) * 2 / 3;
    each.log_time_a -= narrower;
    each.log_time_b -= narrower - (each.factors.at("skip") == "bricks" ? std::log(1.4) : 0);
  }
  EXPECT_FALSE(correlate(cases).admitted());
  const Correlation result = correlate(cases, {0, 0}, true);
  EXPECT_LT(result.rho, CorrelationModel::least_rho);
  ASSERT_TRUE(result.admitted()) << fmt::format("{}", fmt::join(result.refusals, "; "));
  EXPECT_EQ(result.line_beside, "skip=bricks");
  EXPECT_TRUE(result.levels.front().slower);
  EXPECT_EQ(result.levels.front().level, "bricks");
  EXPECT_EQ(std::ranges::count_if(result.levels, &LevelEffect::slower), 1);
}

// A device whose times hardly differ is as much itself as any other.
TEST(Correlation, OfItselfTimesNeedNotDiffer) {
  auto cases = Bench{.slope = 1, .noise = 0.02}.draw(6);
  for (CorrelationCase& each : cases) {
    if (each.anchor) continue;
    const double narrower = (each.log_time_a - 14) * 0.97;
    each.log_time_a -= narrower;
    each.log_time_b -= narrower;
  }
  const Correlation by_another = correlate(cases);
  ASSERT_LT(by_another.rho, CorrelationModel::least_rho);
  EXPECT_FALSE(by_another.admitted());
  const Correlation of_itself = correlate(cases, {0, 0}, true);
  EXPECT_TRUE(of_itself.admitted()) << fmt::format("{}", fmt::join(of_itself.refusals, "; "));
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

// On either side of any other level half are slower, and which of them count as wild is chance.
TEST(Correlation, OfItselfASlowerHalfNamesNoOtherLevel) {
  Bench bench{.slope = 1, .noise = 0.04};
  double size = 0;
  bench.planted = [&](const CorrelationCase& each) {
    return each.factors.at("skip") == "bricks" ? std::log(size) : 0;
  };
  int others = 0;
  constexpr int trials = 300;
  for (const double planted : {1.25, 1.3}) {
    size = planted;
    for (std::uint64_t seed = 1; seed <= trials; ++seed) {
      const auto levels = correlate(bench.draw(seed), {0, 0}, true).levels;
      EXPECT_EQ(levels.front().level, "bricks");
      others += std::ranges::any_of(
          levels, [](const LevelEffect& level) { return level.slower && level.level != "bricks"; });
    }
  }
  EXPECT_LE(others, most(2 * trials, 0.001));
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

}  // namespace
}  // namespace triptych::judge
