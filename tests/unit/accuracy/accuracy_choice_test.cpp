// The longest step and the fastest case within a requested error.

#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/choice.hpp"

namespace triptych::accuracy {
namespace {

TEST(LongestStep, OfASecondOrderErrorIsWithinAQuarterOctave) {
  for (const double error : {1e-2, 1e-3, 3e-5}) {
    int calls = 0;
    const auto found = longest_step(error, {}, [&](double step) {
      ++calls;
      return 2e-3 * step * step;
    });
    ASSERT_TRUE(found);
    EXPECT_LE(found->error, error);
    EXPECT_GE(found->error, error / std::sqrt(2.0) * 0.999);
    EXPECT_DOUBLE_EQ(found->error, 2e-3 * found->step * found->step);
    EXPECT_LE(calls, 14);
  }
}

TEST(LongestStep, IsNotOneThatHitsByChance) {
  // A dip at 4 voxels, asymptotic below 1.
  const auto found =
      longest_step(1e-3, {}, [](double step) { return step == 4 ? 1e-4 : 2e-3 * step * step; });
  ASSERT_TRUE(found);
  EXPECT_LT(found->step, 1);
}

TEST(LongestStep, OfAnExactRuleIsTheLongestOfAll) {
  const auto found =
      longest_step(1e-6, {.shortest = 0.25, .longest = 64}, [](double) { return 0; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->step, 64);
}

TEST(LongestStep, IsNoneWhereTheShortestIsNotEnough) {
  EXPECT_FALSE(longest_step(1e-9, {}, [](double step) { return step; }));
  EXPECT_FALSE(longest_step(1e-3, {}, [](double) { return std::nan(""); }));
}

TEST(Cheapest, IsTheFastestThatKeepsTheError) {
  std::vector<AccuracyCase> cases(4);
  cases[0].time_ns = 1;
  cases[0].rmse = 1e-2;
  cases[1].time_ns = 5;
  cases[1].rmse = 1e-3;
  cases[2].time_ns = 4;
  cases[2].rmse = 9e-4;
  cases[3].time_ns = 9;
  cases[3].rmse = 1e-6;
  EXPECT_EQ(cheapest(cases, 1e-2), 0U);
  EXPECT_EQ(cheapest(cases, 1e-3), 2U);
  EXPECT_EQ(cheapest(cases, 1e-5), 3U);
  EXPECT_EQ(cheapest(cases, 1e-9), std::nullopt);
}

}  // namespace
}  // namespace triptych::accuracy
