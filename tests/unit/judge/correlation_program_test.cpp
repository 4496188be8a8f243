#include "judge/correlation_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "judge/statistics.hpp"
#include "tests/support/normal.hpp"

namespace triptych::judge {
namespace {

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
