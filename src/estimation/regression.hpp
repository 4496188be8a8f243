#pragma once
// Straight lines through pairs of numbers: least squares, and the robust fit on which the
// correlation of two devices rests.

#include <cstddef>
#include <span>
#include <vector>

namespace triptych::estimation {

// Pearson's product-moment correlation of pairs; NaN for fewer than two, or where x or y is
// constant.
[[nodiscard]] double pearson_r(std::span<const double> x, std::span<const double> y);

struct Line {
  double intercept = 0;
  double slope = 0;
  [[nodiscard]] double at(double x) const { return intercept + slope * x; }
};

struct LeastSquares {
  Line line;
  double slope_error = 0;  // standard error
};
// Of y on x; every number is NaN where x is constant, the error also for fewer than three pairs.
[[nodiscard]] LeastSquares least_squares(std::span<const double> x, std::span<const double> y);

// The robust lines below refuse with InputError fewer than four points, values that are not finite
// and x all alike.

// Median of the slopes of all pairs of points with different x (Theil 1950, Sen 1968), through the
// median of y − slope·x. Withstands 29 % of wild points.
[[nodiscard]] Line theil_sen(std::span<const double> x, std::span<const double> y);

// Tukey's bisquare: ρ(u) = 1 − (1 − u²)³, 1 beyond |u| = 1, for u = residual/(c·scale).
struct Bisquare {
  // Half of the points may be wild: E ρ = 1/2 for normal residuals at this c.
  static constexpr double c_breakdown = 1.54764;
  // 95 % of least squares' efficiency for normal residuals.
  static constexpr double c_efficient = 4.685061;
};

// Yohai 1987: an S-estimate finds the line with the smallest robust scale, whatever half of the
// points does; an M-estimate with that scale kept starts there and regains the efficiency.
struct RobustLine {
  Line line;
  double scale = 0;  // ŝ; estimates the standard deviation of normal residuals; the sum of ρ is
                     // divided by n − 2, as least squares does
  double intercept_error = 0;  // standard errors, see robust_variance
  double slope_error = 0;
  double slope_intercept_covariance = 0;
  std::vector<double> residuals;
  std::vector<double> weights;  // of the last step, in [0, 1]; 0: wild
  // h of a point: what the fit's own error adds to its residual's variance, in units of ŝ². Over
  // the points with their weights: 1/Σw + (x − x̄)²/Σw(x − x̄)².
  std::vector<double> leverages;
};

// Where more than half of the points lie on one line exactly, the scale and the errors are 0.
[[nodiscard]] RobustLine robust_line(std::span<const double> x, std::span<const double> y);

// Weight of a residual in an M-estimate at c_efficient: (1 − u²)², 0 beyond.
[[nodiscard]] double bisquare_weight(double residual, double scale);

// κ = [Σψ²/(n − p)] / [Σψ′/n]², in units of scale²: the asymptotic variance of an M-estimate is
// κ·scale²·(XᵀWX/mean w)⁻¹ (Koller & Stahel 2011, with the weights in the design so that a wild
// point far out adds no certainty). 1/0.95 for normal residuals and many points.
[[nodiscard]] double robust_variance(std::span<const double> residuals, double scale,
                                     std::size_t parameters);

}  // namespace triptych::estimation
