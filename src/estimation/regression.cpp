#include "estimation/regression.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"
#include "estimation/statistics.hpp"

namespace triptych::estimation {
namespace {

using Points = std::span<const double>;

constexpr std::size_t parameters = 2;
// The breakdown point (the tolerated share of outliers). The scale of the residuals is chosen so
// that the mean of ρ, Tukey's bisquare function (regression.hpp), has this value.
constexpr double half = 0.5;
constexpr int most_steps = 200;
constexpr double step_tolerance = 1e-10;
// The maximum number of lines through two points that the S-estimate tries. For up to 45 points, it
// tries the lines through all pairs; for more points, it tries lines through random pairs. If half
// of the points are outliers, the probability that every one of 990 pairs contains an outlier is
// 0.75⁹⁹⁰.
constexpr std::size_t most_pairs = 990;

void require_points(Points x, Points y) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (x.size() != y.size() || x.size() < 4) {
    throw core::InputError(
        "a line fit needs an equal number of x and y values, and at least four points");
  }
  if (!std::ranges::all_of(x, finite) || !std::ranges::all_of(y, finite)) {
    throw core::InputError("the values for a line fit must be finite");
  }
  if (std::ranges::all_of(x, [&](double value) { return value == x.front(); })) {
    throw core::InputError("the points for a line fit must not all have the same x");
  }
}

std::vector<double> residuals_of(Points x, Points y, const Line& line) {
  std::vector<double> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = y[i] - line.at(x[i]);
  return result;
}

// Weighted sums over the x coordinates of points: Σw, the weighted mean of x, and Σw(x − mean)².
struct Design {
  double weight = 0;
  double centre = 0;
  double spread = 0;
};

Design design_of(Points x, Points weights) {
  Design design;
  for (std::size_t i = 0; i < x.size(); ++i) {
    design.weight += weights[i];
    design.centre += weights[i] * x[i];
  }
  design.centre /= design.weight;
  for (std::size_t i = 0; i < x.size(); ++i) {
    design.spread += weights[i] * (x[i] - design.centre) * (x[i] - design.centre);
  }
  return design;
}

Line weighted_line(Points x, Points y, Points weights) {
  const Design design = design_of(x, weights);
  double sum_y = 0;
  double product = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_y += weights[i] * y[i];
    product += weights[i] * (x[i] - design.centre) * y[i];
  }
  const double slope = product / design.spread;
  return {sum_y / design.weight - slope * design.centre, slope};
}

double rho(double u) {
  const double rest = 1 - std::min(u * u, 1.0);
  return 1 - rest * rest * rest;
}

// Returns Σρ/(n − 2) for the n residuals, where ρ is Tukey's bisquare function (regression.hpp).
// The scale of the residuals is the value of `scale` for which this result is 1/2.
double mean_rho(Points residuals, double scale) {
  double sum = 0;
  for (const double residual : residuals) sum += rho(residual / (Bisquare::c_breakdown * scale));
  return sum / static_cast<double>(residuals.size() - parameters);
}

// Returns a lower limit for the scale of residuals. Smaller residuals are attributed to rounding.
double least_scale(Points y) {
  double largest = 0;
  for (const double value : y) largest = std::max(largest, std::abs(value));
  return 1e-13 * std::max(largest, std::numeric_limits<double>::min());
}

// Returns the scale of the residuals: the number s for which mean_rho(residuals, s) is 1/2, or 0 if
// s is not above `least`. The iteration s² ← s²·mean_rho(residuals, s)/½ approaches s from one side
// (Maronna et al. 2019, section 9.4).
double m_scale(Points residuals, double least) {
  std::vector<double> sizes(residuals.size());
  std::ranges::transform(residuals, sizes.begin(), [](double r) { return std::abs(r); });
  double scale = normal_mad * median(sizes);
  if (scale <= least) return 0;
  for (int step = 0; step < most_steps; ++step) {
    const double next = scale * std::sqrt(mean_rho(residuals, scale) / half);
    if (!(next > least)) return 0;
    const bool done = std::abs(next / scale - 1) < step_tolerance;
    scale = next;
    if (done) break;
  }
  return scale;
}

double weight_at(double residual, double scale, double c) {
  const double u = residual / (c * scale);
  const double rest = 1 - std::min(u * u, 1.0);
  return rest * rest;
}

std::vector<double> weights_of(Points residuals, double scale, double c) {
  std::vector<double> weights(residuals.size());
  std::ranges::transform(residuals, weights.begin(),
                         [&](double residual) { return weight_at(residual, scale, c); });
  return weights;
}

struct Candidate {
  Line line;
  double scale = std::numeric_limits<double>::infinity();
};

// Refines a line by iteratively reweighted least squares until it converges. No step increases the
// scale of the residuals.
Candidate refined(Points x, Points y, Line line, double least) {
  Candidate best{line, m_scale(residuals_of(x, y, line), least)};
  for (int step = 0; step < most_steps && best.scale > 0; ++step) {
    const auto residuals = residuals_of(x, y, best.line);
    const auto weights = weights_of(residuals, best.scale, Bisquare::c_breakdown);
    if (!(design_of(x, weights).spread > 0)) break;
    const Line next = weighted_line(x, y, weights);
    const double scale = m_scale(residuals_of(x, y, next), least);
    if (!(scale < best.scale * (1 - step_tolerance))) break;
    best = {next, scale};
  }
  return best;
}

// Stores the line whose residuals have the smallest scale so far. try_pair() examines the line
// through two points. If its scale is smaller than the stored scale, the line is refined and
// replaces the stored line. For this comparison, try_pair() need not compute the scale of the new
// line: the scale is smaller if mean_rho() at the stored scale is below 1/2, because mean_rho()
// decreases with the scale.
class SmallestScale {
 public:
  SmallestScale(Points x, Points y) : x_(x), y_(y), least_(least_scale(y)) {}

  void start_at(const Line& line) { keep_smaller(refined(x_, y_, line, least_)); }

  void try_pair(std::size_t i, std::size_t j) {
    if (x_[i] == x_[j] || best_.scale == 0) return;
    const double slope = (y_[j] - y_[i]) / (x_[j] - x_[i]);
    const Line line{y_[i] - slope * x_[i], slope};
    const auto residuals = residuals_of(x_, y_, line);
    if (mean_rho(residuals, best_.scale) < half) keep_smaller(refined(x_, y_, line, least_));
  }

  [[nodiscard]] const Candidate& best() const { return best_; }

 private:
  void keep_smaller(const Candidate& candidate) {
    if (candidate.scale < best_.scale) best_ = candidate;
  }
  Points x_;
  Points y_;
  double least_;
  Candidate best_;
};

Candidate s_estimate(Points x, Points y) {
  SmallestScale search(x, y);
  search.start_at(theil_sen(x, y));
  const std::size_t n = x.size();
  if (n * (n - 1) / 2 <= most_pairs) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) search.try_pair(i, j);
    }
  } else {
    core::Random random(n);  // a fixed seed, so that the same points always yield the same pairs
    for (std::size_t k = 0; k < most_pairs; ++k) {
      search.try_pair(random.bits() % n, random.bits() % n);
    }
  }
  return search.best();
}

Line m_estimate(Points x, Points y, const Candidate& start) {
  Line line = start.line;
  for (int step = 0; step < most_steps; ++step) {
    const auto weights = weights_of(residuals_of(x, y, line), start.scale, Bisquare::c_efficient);
    const Line next = weighted_line(x, y, weights);
    const auto change_at = [&](double at) { return std::abs(next.at(at) - line.at(at)); };
    const bool done = std::max(change_at(std::ranges::min(x)), change_at(std::ranges::max(x))) <
                      step_tolerance * start.scale;
    line = next;
    if (done) break;
  }
  return line;
}

double median_intercept(Points x, Points y, double slope) {
  return median(residuals_of(x, y, {0, slope}));
}

std::vector<double> pair_slopes(Points x, Points y) {
  std::vector<double> slopes;
  slopes.reserve(x.size() * (x.size() - 1) / 2);
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      if (x[i] != x[j]) slopes.push_back((y[j] - y[i]) / (x[j] - x[i]));
    }
  }
  return slopes;
}

void add_errors(RobustLine& fit, Points x) {
  const Design design = design_of(x, fit.weights);
  for (const double value : x) {
    const double distance = value - design.centre;
    fit.leverages.push_back(1 / design.weight + distance * distance / design.spread);
  }
  if (!(fit.scale > 0)) return;
  const double variance = robust_variance(fit.residuals, fit.scale, parameters) * fit.scale *
                          fit.scale * design.weight / static_cast<double>(x.size());
  fit.slope_error = std::sqrt(variance / design.spread);
  fit.intercept_error =
      std::sqrt(variance * (1 / design.weight + design.centre * design.centre / design.spread));
  fit.slope_intercept_covariance = -variance * design.centre / design.spread;
}

}  // namespace

double pearson_r(Points x, Points y) {
  const double x_mean = mean(x);
  const double y_mean = mean(y);
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    yy += (y[i] - y_mean) * (y[i] - y_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  if (!(xx > 0) || !(yy > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::clamp(xy / std::sqrt(xx) / std::sqrt(yy), -1.0, 1.0);
}

LeastSquares least_squares(Points x, Points y) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> ones(x.size(), 1);
  const Design design = design_of(x, ones);
  if (!(design.spread > 0)) return {{none, none}, none};
  const Line line = weighted_line(x, y, ones);
  if (x.size() <= parameters) return {line, none};
  const auto residuals = residuals_of(x, y, line);
  const double squares =
      std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  const double variance = squares / static_cast<double>(x.size() - parameters);
  return {line, std::sqrt(variance / design.spread)};
}

Line theil_sen(Points x, Points y) {
  require_points(x, y);
  const double slope = median(pair_slopes(x, y));
  return {median_intercept(x, y, slope), slope};
}

double bisquare_weight(double residual, double scale) {
  return weight_at(residual, scale, Bisquare::c_efficient);
}

double robust_variance(Points residuals, double scale, std::size_t fitted_parameters) {
  double squares = 0;
  double slopes = 0;
  for (const double residual : residuals) {
    const double u = residual / (Bisquare::c_efficient * scale);
    if (std::abs(u) >= 1) continue;
    const double rest = 1 - u * u;
    const double psi = residual / scale * rest * rest;
    squares += psi * psi;
    slopes += rest * (1 - 5 * u * u);  // ψ′, the derivative of ψ (regression.hpp)
  }
  const auto n = static_cast<double>(residuals.size());
  const double mean_slope = slopes / n;
  return squares / (n - static_cast<double>(fitted_parameters)) / (mean_slope * mean_slope);
}

RobustLine robust_line(Points x, Points y) {
  require_points(x, y);
  const Candidate start = s_estimate(x, y);
  RobustLine fit;
  fit.scale = start.scale;
  if (start.scale > 0) {
    fit.line = m_estimate(x, y, start);
    fit.residuals = residuals_of(x, y, fit.line);
    fit.weights = weights_of(fit.residuals, fit.scale, Bisquare::c_efficient);
  } else {
    fit.line = start.line;
    fit.residuals = residuals_of(x, y, fit.line);
    const double rounding = 10 * least_scale(y);
    for (const double residual : fit.residuals) {
      fit.weights.push_back(std::abs(residual) <= rounding ? 1 : 0);
    }
  }
  add_errors(fit, x);
  return fit;
}

}  // namespace triptych::estimation
