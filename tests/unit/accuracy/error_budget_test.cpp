// Tests the search for the step and the threshold of early ray termination that use up a requested
// error.

#include "accuracy/error_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace triptych::accuracy {
namespace {

struct Settings {
  double step = 0;
  double threshold = 0;
};
using ErrorOf = std::function<double(const Settings&)>;

struct Found {
  std::optional<Settings> cheapest;
  std::optional<Settings> nearest;
  int measured = 0;
};

// A longer step and a larger threshold both save samples.
double samples(const Settings& settings) {
  return 1e6 / settings.step * (1 - 20 * settings.threshold);
}

Found search(double error, const Settings& start, const ErrorOf& error_of,
             const StepLimits& limits = {}, bool counted = true) {
  const double threshold = start.threshold;
  BudgetSearch search(error, start.step, limits, {threshold, 4 * threshold, 16 * threshold});
  const auto settings_of = [&](const BudgetPlace& place) {
    return Settings{search.step_of(place), search.threshold_of(place)};
  };
  Found found;
  for (auto places = search.next(); !places.empty(); places = search.next()) {
    for (const BudgetPlace& place : places) {
      const Settings settings = settings_of(place);
      search.add(place, {error_of(settings), counted ? samples(settings) : 0});
      ++found.measured;
    }
  }
  if (const auto best = search.cheapest()) found.cheapest = settings_of(*best);
  if (const auto nearest = search.nearest()) found.nearest = settings_of(*nearest);
  return found;
}

// The errors of the step and of early termination are independent, so their squares add up.
ErrorOf independent(double of_step, double order, double of_threshold) {
  return [=](const Settings& settings) {
    return std::hypot(of_step * std::pow(settings.step, order), of_threshold * settings.threshold);
  };
}

TEST(BudgetSearch, FindsTheLongestStepThatMeetsTheError) {
  constexpr double error = 1e-3;
  for (const double order : {1.0, 2.0, 4.0}) {
    // A fixed share of 0.7 for the step leads to the first step.
    const double longest = std::pow(error / 2e-3, 1 / order);
    const double first = std::pow(0.7 * error / 2e-3, 1 / order);
    const ErrorOf error_of = independent(2e-3, order, 0);
    const Found found = search(error, {first, error / 4}, error_of);
    ASSERT_TRUE(found.cheapest) << order;
    EXPECT_LE(error_of(*found.cheapest), error) << order;
    EXPECT_GT(found.cheapest->step, first) << order;
    EXPECT_LE(found.cheapest->step, longest) << order;
    if (order >= 2) {
      EXPECT_GE(found.cheapest->step, longest / std::exp2(0.25)) << order;
    }
    EXPECT_LE(found.measured, 18) << order;
  }
}

TEST(BudgetSearch, GivesTheErrorToTheSourceThatSavesTheMostSamples) {
  // Early termination causes a smaller error than its threshold, as in most images.
  const ErrorOf error_of = independent(2e-3, 2, 0.1);
  const Found found = search(1e-3, {0.5, 2.5e-4}, error_of);
  ASSERT_TRUE(found.cheapest);
  EXPECT_LE(error_of(*found.cheapest), 1e-3);
  EXPECT_GT(found.cheapest->step, 0.5);
  EXPECT_GT(found.cheapest->threshold, 2.5e-4);
  EXPECT_LT(samples(*found.cheapest), 0.8 * samples({0.5, 2.5e-4}));
}

TEST(BudgetSearch, ShortensAStepThatIsTooLong) {
  const ErrorOf error_of = independent(2e-3, 2, 0.1);
  const Found found = search(1e-3, {4, 2.5e-4}, error_of);
  ASSERT_TRUE(found.cheapest);
  EXPECT_LE(error_of(*found.cheapest), 1e-3);
  EXPECT_GE(found.cheapest->step, 0.5);
}

TEST(BudgetSearch, StopsIfTheStepIsNotTheReason) {
  const Found found = search(1e-3, {1, 2.5e-4}, [](const Settings&) { return 0.1; });
  EXPECT_FALSE(found.cheapest);
  EXPECT_TRUE(found.nearest);
  EXPECT_LE(found.measured, 6);
  const Found undrawn = search(
      1e-3, {1, 2.5e-4}, [](const Settings&) { return std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_FALSE(undrawn.nearest);
  EXPECT_EQ(undrawn.measured, 3);
}

TEST(BudgetSearch, StaysWithinTheLimits) {
  const auto exact = [](const Settings&) { return 0.0; };
  EXPECT_LE(search(1e-3, {1, 2.5e-4}, exact, {.shortest = 0.5, .longest = 1.5}).cheapest->step,
            1.5);
  const Found fixed = search(1e-3, {2, 2.5e-4}, exact, {.shortest = 2, .longest = 2});
  EXPECT_EQ(fixed.cheapest->step, 2);
  EXPECT_EQ(fixed.measured, 3);
}

// A device without counters: the longest step wins, and then the largest threshold.
TEST(BudgetSearch, NeedsNoSampleCounts) {
  const Found found = search(1e-3, {0.5, 2.5e-4}, independent(2e-3, 2, 0), {}, false);
  ASSERT_TRUE(found.cheapest);
  EXPECT_GT(found.cheapest->step, 0.5);
  EXPECT_EQ(found.cheapest->threshold, 16 * 2.5e-4);
}

}  // namespace
}  // namespace triptych::accuracy
