#pragma once
// The statistics the gate rests on. Plain functions of numbers.

#include <cstddef>
#include <span>
#include <vector>

namespace triptych::estimation {

// All of these want at least one finite value (sample_variance: two) and give NaN otherwise.
[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double median(std::span<const double> values);
// Median of the absolute deviations from the median; ×1.4826 estimates a normal standard deviation.
[[nodiscard]] double sample_variance(std::span<const double> values);  // divides by n − 1

inline constexpr double normal_mad = 1.482602218505602;  // 1/Φ⁻¹(3/4)
// P(T > t) for Student's t; `degrees` > 0, infinite for the normal distribution.
[[nodiscard]] double student_t_upper_tail(double t, double degrees);
// The t with P(T > t) = share, share in (0, 1).
[[nodiscard]] double student_t_upper_quantile(double share, double degrees);

// Benjamini & Hochberg 1995: which hypotheses are rejected when the expected share of false ones
// among the rejected is to stay ≤ q.
[[nodiscard]] std::vector<bool> benjamini_hochberg(std::span<const double> p_values, double q);

// Each p-value as the smallest q at which the same procedure rejects it.
[[nodiscard]] std::vector<double> benjamini_hochberg_adjusted(std::span<const double> p_values);

// Variances of many groups borrow strength from one another: a scaled inverse chi-square prior with
// d₀ degrees of freedom around s₀², fitted to the groups' variances by the moments of ln s²
// (Smyth 2004, "Linear models and empirical Bayes methods", section 6.2).
struct VariancePrior {
  double degrees = 0;   // d₀; infinite where the variances differ no more than chance makes them
  double variance = 0;  // s₀²
};
// `variances` > 0 with their `degrees` > 0. One group teaches nothing: d₀ = 0.
[[nodiscard]] VariancePrior fit_variance_prior(std::span<const double> variances,
                                               std::span<const double> degrees);
// s̃² = (d₀s₀² + d·s²)/(d₀ + d)
[[nodiscard]] double moderated_variance(const VariancePrior& prior, double variance,
                                        double degrees);
// The x > 0 with ψ'(x) = y, y > 0.
[[nodiscard]] double inverse_trigamma(double y);

}  // namespace triptych::estimation
