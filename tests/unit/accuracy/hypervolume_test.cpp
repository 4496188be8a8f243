// Tests the area dominated by a Pareto front, with points whose decimal logarithms are integers.

#include "accuracy/hypervolume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace triptych::accuracy {
namespace {

const double decade = std::log(10.0);

AccuracyCase case_at(double time_ns, double rmse) {
  return {.configuration = {},
          .factors = {},
          .time_ns = time_ns,
          .samples = {},
          .instructions = {},
          .fetched = {},
          .memory = {},
          .joules = {},
          .rmse = rmse};
}

// Returns the area in units of one decade of time times one decade of error.
double area_of(const std::vector<AccuracyCase>& cases, double reference_error = 1) {
  return hypervolume(cases, pareto_front(cases), reference_error) / (decade * decade);
}

// The area extends up to the reference point, which is a time of one second and an error of 1. A
// time of 1 ms is three decades below one second, and an error of 1e-2 is two decades below 1, so
// the area is 3·2. Reducing the error from 1e-2 to 1e-4 takes 10 ms and adds 2·2.
TEST(Hypervolume, IsTheSumOfRectangles) {
  EXPECT_NEAR(area_of({case_at(1e6, 1e-2)}), 6, 1e-12);
  EXPECT_NEAR(area_of({case_at(1e6, 1e-2), case_at(1e7, 1e-4)}), 10, 1e-12);
  EXPECT_NEAR(area_of({case_at(1e6, 1e-2), case_at(1e7, 1e-4)}, 0.1), 7, 1e-12);
}

TEST(Hypervolume, DependsOnlyOnTheFront) {
  const double alone = area_of({case_at(1e6, 1e-2), case_at(1e7, 1e-4)});
  EXPECT_EQ(
      area_of({case_at(1e7, 1e-4), case_at(2e6, 2e-2), case_at(1e6, 1e-2), case_at(1e7, 1e-3)}),
      alone);
  EXPECT_GT(area_of({case_at(1e6, 1e-2), case_at(5e6, 1e-3), case_at(1e7, 1e-4)}), alone);
}

TEST(Hypervolume, IgnoresCasesBeyondTheReferencePoint) {
  EXPECT_EQ(area_of({}), 0);
  EXPECT_EQ(area_of({case_at(1e6, 1)}), 0);     // no better than an empty image
  EXPECT_EQ(area_of({case_at(2e9, 1e-4)}), 0);  // slower than the limit of one second
  EXPECT_NEAR(area_of({case_at(1e5, 2), case_at(1e6, 0.1), case_at(2e9, 1e-3)}), 3, 1e-12);
  AccuracyCase untimed = case_at(0, 1e-3);
  untimed.time_ns.reset();
  EXPECT_NEAR(area_of({case_at(1e6, 1e-2), untimed}), 6, 1e-12);
}

// The smallest possible error is the rounding to floats, so an error of 0 counts as 2⁻²⁴.
TEST(Hypervolume, AnExactImageHasAFiniteArea) {
  EXPECT_NEAR(area_of({case_at(1e6, 0)}), 3 * 24 * std::log10(2.0), 1e-12);
  EXPECT_EQ(area_of({case_at(1e6, 1e-9)}), area_of({case_at(1e6, 0)}));
}

// If all times are 2.5 times as long, ln time grows by ln 2.5. Over four decades of error, whose
// width is 4·ln 10, the area shrinks by ln 2.5 · 4·ln 10. The reported factor is 2.5.
TEST(Hypervolume, ReportsHowManyTimesAsLongADeviceTakes) {
  const auto area_at = [](double factor) {
    const std::vector<AccuracyCase> cases{case_at(1e6 * factor, 1e-2), case_at(1e7 * factor, 1e-4)};
    return front_area(cases, pareto_front(cases), 1);
  };
  const auto best = area_at(1);
  const auto other = area_at(2.5);
  ASSERT_TRUE(best && other);
  EXPECT_NEAR(best->area - other->area, std::log(2.5) * 4 * decade, 1e-12);
  EXPECT_NEAR(equal_slowdown(*best, *other), 2.5, 1e-12);
  EXPECT_EQ(equal_slowdown(*best, *best), 1);
}

TEST(Hypervolume, IsAbsentIfNothingWasTimed) {
  AccuracyCase untimed = case_at(0, 1e-3);
  untimed.time_ns.reset();
  const std::vector<AccuracyCase> cases{untimed};
  EXPECT_TRUE(pareto_front(cases).empty());
  EXPECT_FALSE(front_area(cases, pareto_front(cases), 1));
  EXPECT_FALSE(front_area(std::vector{case_at(1e6, 2)}, std::vector<std::size_t>{0}, 1));
}

}  // namespace
}  // namespace triptych::accuracy
