#include "core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace triptych::core {
namespace {

// The first outputs of the authors' reference implementation for the seed 1234567.
TEST(Random, MatchesTheReferenceSequence) {
  Random random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317U);
  EXPECT_EQ(random.bits(), 3203168211198807973U);
  EXPECT_EQ(random.bits(), 9817491932198370423U);
  EXPECT_EQ(random.bits(), 4593380528125082431U);
  EXPECT_EQ(random.bits(), 16408922859458223821U);
}

TEST(Random, UniformFillsItsInterval) {
  Random random(1);
  double lowest = 10;
  double highest = 0;
  double sum = 0;
  constexpr int draws = 100000;
  for (int i = 0; i < draws; ++i) {
    const double x = random.uniform(2, 5);
    ASSERT_GE(x, 2);
    ASSERT_LT(x, 5);
    lowest = std::min(lowest, x);
    highest = std::max(highest, x);
    sum += x;
  }
  EXPECT_LT(lowest, 2.001);
  EXPECT_GT(highest, 4.999);
  // The tolerance is five standard errors of the mean of 1e5 values, 5·(3/√12)/√1e5.
  EXPECT_NEAR(sum / draws, 3.5, 0.0137);
}

TEST(Random, IsUsableAtCompileTime) {
  constexpr double x = Random(3).uniform();
  static_assert(x >= 0 && x < 1);
  EXPECT_EQ(Random(3).uniform(), x);
}

}  // namespace
}  // namespace triptych::core
