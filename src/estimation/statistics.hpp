#pragma once
// Statistics for the gate (Triptych's regression check), as plain functions of numbers.

#include <cstddef>
#include <span>
#include <vector>

namespace triptych::estimation {

// These functions return NaN for an empty span (sample_variance: for fewer than two values).
[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double median(std::span<const double> values);
[[nodiscard]] double sample_variance(std::span<const double> values);  // divides by n − 1

// The median absolute deviation from the median, multiplied by this factor, estimates the standard
// deviation of a normal distribution.
inline constexpr double normal_mad = 1.482602218505602;  // 1/Φ⁻¹(3/4)
// Returns P(T > t) for Student's t distribution with `degrees` > 0 degrees of freedom. Infinite
// degrees of freedom give the normal distribution.
[[nodiscard]] double student_t_upper_tail(double t, double degrees);
// Returns the value t for which P(T > t) = share, for a share in (0, 1).
[[nodiscard]] double student_t_upper_quantile(double share, double degrees);

// Returns which hypotheses are rejected by the procedure of Benjamini & Hochberg (1995), which
// limits the expected fraction of false rejections among all rejections to q.
[[nodiscard]] std::vector<bool> benjamini_hochberg(std::span<const double> p_values, double q);

// Returns, for each p-value, the smallest q at which benjamini_hochberg() rejects its hypothesis.
[[nodiscard]] std::vector<double> benjamini_hochberg_adjusted(std::span<const double> p_values);

// Estimates of the variances s² of many groups become more accurate if they are combined. The prior
// distribution of the variances is a scaled inverse chi-square distribution with d₀ degrees of
// freedom around s₀². It is fitted to the mean and the variance of ln s² over the groups (Smyth
// 2004, "Linear models and empirical Bayes methods", section 6.2).
struct VariancePrior {
  double degrees = 0;   // d₀; infinite if the variances differ no more than expected by chance
  double variance = 0;  // s₀²
};
// Fits the prior to the variances and their degrees of freedom, all of which must be positive. With
// a single group, d₀ is 0, because there is nothing to combine.
[[nodiscard]] VariancePrior fit_variance_prior(std::span<const double> variances,
                                               std::span<const double> degrees);
// Returns the moderated variance s̃² = (d₀s₀² + d·s²)/(d₀ + d) of a group with the variance s² and
// d degrees of freedom, for a prior with the parameters d₀ and s₀².
[[nodiscard]] double moderated_variance(const VariancePrior& prior, double variance,
                                        double degrees);
// Returns the x > 0 for which the trigamma function ψ'(x) is y, for y > 0.
[[nodiscard]] double inverse_trigamma(double y);

}  // namespace triptych::estimation
