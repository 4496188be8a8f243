#pragma once
// Fits straight lines to pairs of numbers: by least squares, and by the robust method that is used
// to correlate two devices.

#include <cstddef>
#include <span>
#include <vector>

namespace triptych::estimation {

// Returns Pearson's correlation coefficient, or NaN if there are fewer than two pairs or if x or y
// is constant.
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
// Fits the regression line of y on x. All numbers are NaN if x is constant. The error is also NaN
// if there are fewer than three pairs.
[[nodiscard]] LeastSquares least_squares(std::span<const double> x, std::span<const double> y);

// theil_sen() and robust_line() throw InputError if there are fewer than four points, if a value is
// not finite, or if all x are equal.

// Returns the line whose slope is the median of the slopes of all pairs of points with different x
// (Theil 1950, Sen 1968), and whose intercept is the median of y − slope·x. It tolerates 29 %
// outliers.
[[nodiscard]] Line theil_sen(std::span<const double> x, std::span<const double> y);

// Tukey's bisquare function: ρ(u) = 1 − (1 − u²)³ for |u| ≤ 1, otherwise 1. Here u is
// residual/(c·scale), where `scale` is a robust standard deviation of the residuals and c is one of
// these constants.
struct Bisquare {
  // With this c, the mean of ρ is 1/2 for normal residuals, so up to half of the points may be
  // outliers.
  static constexpr double c_breakdown = 1.54764;
  // With this c, the estimate has 95 % of the efficiency of least squares for normal residuals.
  static constexpr double c_efficient = 4.685061;
};

// Yohai's MM-estimate (1987). First, an S-estimate finds the line with the smallest robust scale,
// even if almost half of the points are outliers. Then an M-estimate with this scale starts from
// this line, and regains the efficiency of least squares.
struct RobustLine {
  Line line;
  // The scale ŝ, which estimates the standard deviation of the residuals if they are normal. In the
  // definition of ŝ, the sum of ρ over n points is divided by n − 2, as least squares divides the
  // sum of squares.
  double scale = 0;
  double intercept_error = 0;  // standard error, see robust_variance
  double slope_error = 0;
  double slope_intercept_covariance = 0;
  std::vector<double> residuals;
  std::vector<double> weights;  // weights of the last iteration, in [0, 1]; 0 for an outlier
  // The leverage h of each point: the variance that the error of the fit adds to the point's
  // residual, in units of ŝ². With the weights w of the points and the weighted mean x̄ of x,
  // h = 1/Σw + (x − x̄)²/Σw(x − x̄)².
  std::vector<double> leverages;
};

// Fits a robust line. If more than half of the points are exactly on one line, the scale and the
// errors are 0.
[[nodiscard]] RobustLine robust_line(std::span<const double> x, std::span<const double> y);

// Returns the weight of a residual in an M-estimate at c_efficient: (1 − u²)² for |u| ≤ 1,
// otherwise 0.
[[nodiscard]] double bisquare_weight(double residual, double scale);

// Returns κ = [Σψ²/(n − p)] / [Σψ′/n]² for n residuals and p fitted parameters. Both sums are over
// ψ and its derivative ψ′ at r = residual/scale, where ψ(r) = r·(1 − u²)² with u = r/c_efficient if
// |u| ≤ 1, otherwise 0. The asymptotic variance of an M-estimate is κ·scale²·(XᵀWX/mean w)⁻¹
// (Koller & Stahel 2011), where X is the design matrix and W contains the weights w of the points.
// Without W, a distant outlier would make the estimate look more certain. κ is 1/0.95 for normal
// residuals and many points.
[[nodiscard]] double robust_variance(std::span<const double> residuals, double scale,
                                     std::size_t fitted_parameters);

}  // namespace triptych::estimation
