#include "scene/exact_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/hash.hpp"

namespace triptych::scene {
namespace {

TEST(ExactMath, SineAndCosineAgreeWithTheLibrary) {
  for (int i = -3000; i <= 3000; ++i) {
    const double turns = i / 777.0;
    EXPECT_NEAR(sine_turns(turns), std::sin(2 * std::numbers::pi * turns), 5e-15) << turns;
    EXPECT_NEAR(cosine_turns(turns), std::cos(2 * std::numbers::pi * turns), 5e-15) << turns;
  }
}

TEST(ExactMath, QuarterTurnsAreExact) {
  for (int k = -3; k <= 3; ++k) {
    EXPECT_EQ(sine_turns(k), 0);
    EXPECT_EQ(sine_turns(k + 0.25), 1);
    EXPECT_EQ(sine_turns(k + 0.5), 0);
    EXPECT_EQ(sine_turns(k + 0.75), -1);
    EXPECT_EQ(cosine_turns(k), 1);
    EXPECT_EQ(cosine_turns(k + 0.25), 0);
    EXPECT_EQ(cosine_turns(k + 0.5), -1);
    EXPECT_EQ(cosine_turns(k + 0.75), 0);
  }
}

TEST(ExactMath, SineIsOddAndCosineEven) {
  for (int i = 1; i < 500; ++i) {
    const double turns = i / 1000.0;
    EXPECT_EQ(sine_turns(-turns), -sine_turns(turns));
    EXPECT_EQ(cosine_turns(-turns), cosine_turns(turns));
  }
}

TEST(ExactMath, ExponentialAndLogarithmAgreeWithTheLibrary) {
  for (double x = -699; x < 700; x += 0.37) {
    EXPECT_NEAR(exponential(x) / std::exp(x), 1, 2e-13) << x;
  }
  for (double x = 1e-300; x < 1e300; x *= 1.7) {
    EXPECT_NEAR(logarithm(x), std::log(x), 3e-16 * std::max(1.0, std::abs(std::log(x)))) << x;
  }
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-701), 0);
  EXPECT_EQ(logarithm(1), 0);
}

TEST(ExactMath, LogarithmOf1PlusAgreesWithTheLibrary) {
  for (double x = 1e-300; x < 1e300; x *= 1.3) {
    EXPECT_NEAR(logarithm_of_1_plus(x) / std::log1p(x), 1, 1e-15) << x;
    if (x < 1) {
      EXPECT_NEAR(logarithm_of_1_plus(-x) / std::log1p(-x), 1, 1e-15) << -x;
    }
  }
  EXPECT_EQ(logarithm_of_1_plus(0), 0);
  EXPECT_EQ(logarithm_of_1_plus(-1), -std::numeric_limits<double>::infinity());
}

// The results must be bit-identical on every machine.
TEST(ExactMath, MakesTheSameBitsEverywhere) {
  core::HashBuilder bits("exact maths");
  for (int i = -500; i <= 500; ++i) {
    const double x = i / 7.0;
    bits.add(sine_turns(x)).add(cosine_turns(x)).add(exponential(x));
    if (i > 0) bits.add(logarithm(x)).add(logarithm_of_1_plus(x)).add(logarithm_of_1_plus(-1 / x));
  }
  EXPECT_EQ(bits.hash(), "20bf13eb24ffb2533b9cd8fd62dd7c4f");
}

}  // namespace
}  // namespace triptych::scene
