#pragma once
// Kolmogorov–Smirnov tests. Plain functions of numbers.

#include <cstdint>
#include <functional>
#include <span>

namespace triptych::analysis {

struct KsTest {
  double d = 0;  // largest distance of the distribution functions
  double p = 0;  // P(D ≥ d) under the hypothesis of equal distributions
};

// P(Dₙ < d) of the one-sample, two-sided statistic for a fully specified continuous distribution.
// Exact by Durbin's matrix (J. Durbin 1973; Marsaglia, Tsang, Wang 2003 give the recipe); with
// Stephens' √n + 0.12 + 0.11/√n in Kolmogorov's limit where n is large and d far in the tail.
[[nodiscard]] double kolmogorov_below(std::size_t n, double d);

// Kolmogorov's limit: P(√n·D ≥ x) as n grows.
[[nodiscard]] double kolmogorov_limit_above(double x);

// `sample` in any order; `cumulative` is the hypothesis.
[[nodiscard]] KsTest ks_one_sample(std::span<const double> sample,
                                   const std::function<double(double)>& cumulative);

// Two-sided. p is exact (counted over all orders of the joint sample, as if there were no ties)
// where sizes allow, else Kolmogorov's limit with Stephens' correction.
[[nodiscard]] KsTest ks_two_samples(std::span<const double> a, std::span<const double> b);

// p of a KS test against a normal distribution whose mean and variance were estimated from the same
// sample by maximum likelihood (Lilliefors 1967): share of `replicates` normal samples, seeded,
// with a D at least as large, (1 + k)/(1 + replicates). n ≥ 3.
[[nodiscard]] double lilliefors_p(double d, std::size_t n, std::size_t replicates,
                                  std::uint64_t seed);

[[nodiscard]] double normal_below(double z);

}  // namespace triptych::analysis
