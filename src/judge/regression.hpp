#pragma once
// Straight lines through pairs of numbers.

#include <span>

namespace triptych::judge {

// Pearson's product-moment correlation of pairs; NaN for fewer than two, or where x or y is
// constant.
[[nodiscard]] double pearson_r(std::span<const double> x, std::span<const double> y);

struct Line {
  double intercept = 0;
  double slope = 0;
  double r = 0;               // Pearson's
  double residual_scale = 0;  // √(Σ residual² / (n − 2))
};
// Ordinary least squares of y on x; every number is NaN where x is constant, residual_scale also
// for fewer than three pairs.
[[nodiscard]] Line least_squares(std::span<const double> x, std::span<const double> y);

}  // namespace triptych::judge
