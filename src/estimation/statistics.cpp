#include "estimation/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/polygamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace triptych::estimation {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
// Above this number of degrees of freedom, Student's t distribution equals the normal distribution
// in double precision, and Boost's series loses digits.
constexpr double normal_degrees = 1e8;

}  // namespace

double mean(std::span<const double> values) {
  if (values.empty()) return not_a_number;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::span<const double> values) {
  if (values.empty()) return not_a_number;
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double sample_variance(std::span<const double> values) {
  if (values.size() < 2) return not_a_number;
  const double centre = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - centre) * (value - centre);
  return squares / static_cast<double>(values.size() - 1);
}

double student_t_upper_tail(double t, double degrees) {
  if (std::isinf(t)) return t > 0 ? 0 : 1;
  namespace math = boost::math;
  if (degrees > normal_degrees) return math::cdf(math::complement(math::normal(), t));
  return math::cdf(math::complement(math::students_t(degrees), t));
}

double student_t_upper_quantile(double share, double degrees) {
  namespace math = boost::math;
  if (degrees > normal_degrees) return math::quantile(math::complement(math::normal(), share));
  return math::quantile(math::complement(math::students_t(degrees), share));
}

std::vector<bool> benjamini_hochberg(std::span<const double> p_values, double q) {
  std::vector<double> sorted(p_values.begin(), p_values.end());
  std::ranges::sort(sorted);
  const auto count = static_cast<double>(sorted.size());
  double threshold = -1;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i] <= q * static_cast<double>(i + 1) / count) threshold = sorted[i];
  }
  std::vector<bool> rejected;
  rejected.reserve(p_values.size());
  for (const double p : p_values) rejected.push_back(p <= threshold);
  return rejected;
}

std::vector<double> benjamini_hochberg_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double smallest = 1;
  for (std::size_t rank = order.size(); rank > 0; --rank) {
    const std::size_t i = order[rank - 1];
    smallest = std::min(
        smallest, p_values[i] * static_cast<double>(order.size()) / static_cast<double>(rank));
    adjusted[i] = smallest;
  }
  return adjusted;
}

// Solves ψ'(x) = y, where ψ' is the trigamma function, by Newton's method for 1/ψ'. This function
// is convex and nearly linear, so that the iteration converges from one side (Smyth 2004,
// appendix). For very large and very small y, the asymptotes are exact in double precision.
double inverse_trigamma(double y) {
  if (y > 1e7) return 1 / std::sqrt(y);
  if (y < 1e-6) return 1 / y;
  double x = 0.5 + 1 / y;
  for (int i = 0; i < 50; ++i) {
    const double value = boost::math::trigamma(x);
    const double step = value * (1 - value / y) / boost::math::polygamma(2, x);
    x += step;
    if (-step / x < 1e-12) break;
  }
  return x;
}

VariancePrior fit_variance_prior(std::span<const double> variances,
                                 std::span<const double> degrees) {
  using boost::math::digamma;
  using boost::math::trigamma;
  if (variances.empty()) return {};
  if (variances.size() == 1) return {0, variances.front()};
  // Let s² be the variance of a group, d its degrees of freedom, d₀ and s₀² the parameters of the
  // prior, ψ the digamma function and ψ' the trigamma function. Then ln s² − ψ(d/2) + ln(d/2) has
  // the mean ln s₀² − ψ(d₀/2) + ln(d₀/2) and the variance ψ'(d/2) + ψ'(d₀/2).
  std::vector<double> centred;
  std::vector<double> sampling;
  for (std::size_t i = 0; i < variances.size(); ++i) {
    const double half = degrees[i] / 2;
    centred.push_back(std::log(variances[i]) - digamma(half) + std::log(half));
    sampling.push_back(trigamma(half));
  }
  const double centre = mean(centred);
  const double excess = sample_variance(centred) - mean(sampling);
  if (excess <= 0) return {infinite, std::exp(centre)};
  const double half = inverse_trigamma(excess);
  return {2 * half, std::exp(centre + digamma(half) - std::log(half))};
}

double moderated_variance(const VariancePrior& prior, double variance, double degrees) {
  if (std::isinf(prior.degrees)) return prior.variance;
  return (prior.degrees * prior.variance + degrees * variance) / (prior.degrees + degrees);
}

}  // namespace triptych::estimation
