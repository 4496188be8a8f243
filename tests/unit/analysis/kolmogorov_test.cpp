#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "analysis/kolmogorov.hpp"

namespace triptych::analysis {
namespace {

// Marsaglia, Tsang, Wang 2003, "Evaluating Kolmogorov's distribution", section 2 and 4.
TEST(Kolmogorov, ExactDistributionAsPublished) {
  EXPECT_NEAR(kolmogorov_below(10, 0.274), 0.6284796154565, 1e-12);
  EXPECT_NEAR(kolmogorov_below(2000, 0.04), 0.99676943191713676985, 1e-12);
}

TEST(Kolmogorov, ClosedFormsOfSmallSamples) {
  EXPECT_NEAR(kolmogorov_below(1, 0.75), 0.5, 1e-12);               // 2d − 1
  EXPECT_NEAR(kolmogorov_below(2, 0.4), 2 * 0.3 * 0.3, 1e-12);      // 2!(2d − 1/2)²
  EXPECT_NEAR(kolmogorov_below(2, 0.8), 1 - 2 * 0.2 * 0.2, 1e-12);  // 1 − 2(1 − d)²
  EXPECT_EQ(kolmogorov_below(5, 1), 1);
  EXPECT_EQ(kolmogorov_below(5, 0), 0);
}

// Massey 1951, table 1: the d that is exceeded with probability 0.05.
TEST(Kolmogorov, CriticalValuesOfMassey) {
  EXPECT_NEAR(kolmogorov_below(5, 0.565), 0.95, 2e-3);
  EXPECT_NEAR(kolmogorov_below(10, 0.410), 0.95, 2e-3);
  EXPECT_NEAR(kolmogorov_below(20, 0.294), 0.95, 2e-3);
}

TEST(Kolmogorov, LimitAtItsTabulatedPoints) {
  EXPECT_NEAR(kolmogorov_limit_above(0.82757), 0.5, 1e-4);
  EXPECT_NEAR(kolmogorov_limit_above(1.22385), 0.1, 1e-5);
  EXPECT_NEAR(kolmogorov_limit_above(1.35810), 0.05, 1e-5);
  EXPECT_NEAR(kolmogorov_limit_above(1.62762), 0.01, 1e-5);
  EXPECT_NEAR(kolmogorov_limit_above(1.18), kolmogorov_limit_above(1.18 - 1e-9), 1e-8);
}

TEST(Kolmogorov, OneSampleDistanceByHand) {
  const std::vector<double> sample{0.7, 0.1, 0.4};
  const KsTest test = ks_one_sample(sample, [](double x) { return x; });
  EXPECT_NEAR(test.d, 0.3, 1e-12);  // the empirical distribution is 1 from 0.7 on
  EXPECT_NEAR(test.p, 1 - kolmogorov_below(3, 0.3), 1e-12);
}

TEST(Kolmogorov, TinyPKeepsItsDigits) {
  std::vector<double> sample(400, 0.0);
  for (std::size_t i = 0; i < sample.size(); ++i) sample[i] = 0.5 * static_cast<double>(i) / 400;
  const KsTest test = ks_one_sample(sample, [](double x) { return x; });
  EXPECT_NEAR(test.d, 0.5, 2e-3);
  EXPECT_GT(test.p, 0);
  EXPECT_LT(test.p, 1e-80);
}

// Share of all orders of a joint sample whose distance is at least d.
double by_enumeration(int n, int m, double d) {
  std::vector<int> labels(static_cast<std::size_t>(n + m), 0);
  std::fill(labels.begin() + n, labels.end(), 1);
  int all = 0;
  int as_far = 0;
  do {
    double a = 0;
    double b = 0;
    double largest = 0;
    for (const int label : labels) {
      (label == 0 ? a : b) += 1;
      largest = std::max(largest, std::abs(a / n - b / m));
    }
    ++all;
    if (largest >= d - 1e-9) ++as_far;
  } while (std::ranges::next_permutation(labels).found);
  return static_cast<double>(as_far) / all;
}

TEST(Kolmogorov, TwoSamplesAgainstEnumeration) {
  const std::vector<double> a{1, 2, 5, 9};
  const std::vector<double> b{3, 4, 6, 7, 8, 10};
  const KsTest test = ks_two_samples(a, b);
  EXPECT_NEAR(test.d, 0.5, 1e-12);
  EXPECT_NEAR(test.p, by_enumeration(4, 6, test.d), 1e-12);
  const KsTest apart =
      ks_two_samples(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{6, 7, 8, 9, 10});
  EXPECT_EQ(apart.d, 1);
  EXPECT_NEAR(apart.p, 2.0 / 252, 1e-12);
}

TEST(Kolmogorov, TwoLargeSamplesMeetTheLimit) {
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 300; ++i) {
    a.push_back(i);
    b.push_back(i + 30.5);
  }
  const KsTest exact = ks_two_samples(a, b);
  EXPECT_NEAR(exact.d, 31.0 / 300, 1e-12);
  EXPECT_NEAR(exact.p, kolmogorov_limit_above(std::sqrt(150.0) * exact.d), 0.02);
}

TEST(Kolmogorov, EqualSamplesAreNoEvidence) {
  const std::vector<double> a{1, 1, 2, 3};
  const KsTest test = ks_two_samples(a, a);
  EXPECT_EQ(test.d, 0);
  EXPECT_EQ(test.p, 1);
}

// Lilliefors 1967 in Dallal and Wilkinson's correction: 0.886/√n is exceeded in 5 % for large n.
TEST(Kolmogorov, LillieforsCriticalValue) {
  EXPECT_NEAR(lilliefors_p(0.0886, 100, 4000, 1), 0.05, 0.012);
  EXPECT_LT(lilliefors_p(0.5, 100, 99, 1), 0.0101);
  EXPECT_EQ(lilliefors_p(0.08, 50, 200, 5), lilliefors_p(0.08, 50, 200, 5));
}

}  // namespace
}  // namespace triptych::analysis
