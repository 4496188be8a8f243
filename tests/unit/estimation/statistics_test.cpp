#include "estimation/statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.hpp"

namespace triptych::estimation {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Statistics, Median) {
  EXPECT_DOUBLE_EQ(median(std::array{5.0, 1.0, 3.0}), 3);
  EXPECT_DOUBLE_EQ(median(std::array{4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Statistics, SampleVariance) {
  EXPECT_DOUBLE_EQ(sample_variance(std::array{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}), 32.0 / 7);
  EXPECT_TRUE(std::isnan(sample_variance(std::array{1.0})));
}

// Upper 5 %, 2.5 % and 1 % points from published tables of the t distribution.
TEST(Statistics, StudentTAsTabulated) {
  EXPECT_NEAR(student_t_upper_quantile(0.05, 5), 2.015, 5e-4);
  EXPECT_NEAR(student_t_upper_quantile(0.025, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_t_upper_quantile(0.01, 1), 31.821, 5e-4);
  EXPECT_NEAR(student_t_upper_quantile(0.05, infinite), 1.6449, 5e-5);
  EXPECT_NEAR(student_t_upper_tail(2.015048, 5), 0.05, 1e-7);
}

// The expected values come from a numerical integration of the density with 20 digits.
TEST(Statistics, StudentTByQuadrature) {
  EXPECT_NEAR(student_t_upper_tail(2, 7), 0.042809664281488038, 1e-14);
  EXPECT_NEAR(student_t_upper_tail(3.5, 12.5), 0.0020675705228806399, 1e-15);
  EXPECT_NEAR(student_t_upper_tail(-1, 4), 0.81304951684997056, 1e-14);
  EXPECT_EQ(student_t_upper_tail(infinite, 4), 0);
  EXPECT_EQ(student_t_upper_tail(-infinite, infinite), 1);
}

// The example of Benjamini & Hochberg (1995), section 3.2: four of fifteen hypotheses are rejected
// at q = 0.05.
TEST(Statistics, BenjaminiHochbergAsPublished) {
  const std::array p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                     0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const std::vector<bool> rejected = benjamini_hochberg(p, 0.05);
  EXPECT_EQ(std::ranges::count(rejected, true), 4);
  EXPECT_TRUE(rejected[3]);
}

// If a larger p-value is below its threshold, all smaller p-values are rejected as well, even those
// above their own thresholds. The order of the input does not matter.
TEST(Statistics, BenjaminiHochbergStepsUp) {
  EXPECT_THAT(benjamini_hochberg(std::array{0.049, 0.5, 0.03, 0.05, 0.04}, 0.0625),
              testing::ElementsAre(true, false, true, true, true));
  EXPECT_THAT(benjamini_hochberg(std::array{0.03, 0.5}, 0.05), testing::ElementsAre(false, false));
  EXPECT_TRUE(benjamini_hochberg({}, 0.05).empty());
}

TEST(Statistics, InverseTrigammaOfKnownValues) {
  const double squared = std::numbers::pi * std::numbers::pi;
  EXPECT_NEAR(inverse_trigamma(squared / 6), 1, 1e-10);
  EXPECT_NEAR(inverse_trigamma(squared / 2), 0.5, 1e-10);
  EXPECT_NEAR(inverse_trigamma(squared / 6 - 1), 2, 1e-10);
  EXPECT_NEAR(inverse_trigamma(1e9) * std::sqrt(1e9), 1, 1e-3);
  EXPECT_NEAR(inverse_trigamma(1e-9), 1e9, 1);
}

// The expected values were computed by solving the two moment equations with 20 digits.
TEST(Statistics, VariancePriorByMoments) {
  const std::array variances{0.0004, 0.0009, 0.0001, 0.0016, 0.0025, 0.0002, 0.0100, 0.00005};
  const std::array degrees{7.0, 7.0, 5.0, 7.0, 9.0, 7.0, 7.0, 4.0};
  const VariancePrior prior = fit_variance_prior(variances, degrees);
  EXPECT_NEAR(prior.degrees, 1.4747845752433398, 1e-9);
  EXPECT_NEAR(prior.variance, 0.00030868773849621208, 1e-13);
  EXPECT_NEAR(moderated_variance(prior, variances[0], 7), 0.00038410981263290626, 1e-13);
}

TEST(Statistics, EqualVariancesArePooledCompletely) {
  const VariancePrior prior =
      fit_variance_prior(std::array{1.0, 1.1, 0.9, 1.05}, std::array{7.0, 7.0, 7.0, 7.0});
  EXPECT_TRUE(std::isinf(prior.degrees));
  EXPECT_NEAR(prior.variance, 1.1726794807958619, 1e-12);
  EXPECT_EQ(moderated_variance(prior, 9, 7), prior.variance);
}

TEST(Statistics, OneVarianceIsUnchanged) {
  const VariancePrior prior = fit_variance_prior(std::array{4.0}, std::array{7.0});
  EXPECT_EQ(moderated_variance(prior, 4, 7), 4);
}

TEST(Statistics, AdjustedPValuesAgreeWithTheProcedure) {
  const std::vector<double> p{0.001, 0.8, 0.012, 0.02, 0.04, 0.5};
  const auto adjusted = benjamini_hochberg_adjusted(p);
  for (const double q : {0.005, 0.01, 0.03, 0.05, 0.07, 0.9}) {
    const auto rejected = benjamini_hochberg(p, q);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(adjusted[i] <= q, rejected[i]) << q;
  }
}

}  // namespace
}  // namespace triptych::estimation
