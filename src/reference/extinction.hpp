#pragma once
// Converts between opacity per length, extinction and optical depth.

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych::reference {

[[nodiscard]] inline double extinction_of(double alpha) {
  return -std::log1p(-std::min(alpha, 1.0));
}

[[nodiscard]] inline double opacity_of(double depth) {
  return -std::expm1(-depth);
}

// Returns the optical depth of a segment with this length. The extinction may be infinite.
[[nodiscard]] inline double depth_of(double length, double extinction) {
  return length > 0.0 ? length * extinction : 0.0;
}

// Returns the mean of −ln(1 − alpha) for an alpha that changes linearly from a to b. It is computed
// from the antiderivative F(α) = (1 − α)·ln(1 − α) + α. If F(b) − F(a) would suffer from
// cancellation, it is computed from a series around the middle of a and b instead.
[[nodiscard]] inline double mean_extinction(double a, double b) {
  const double middle = 0.5 * (a + b);
  const double left = 1.0 - middle;
  if (!(left > 0.0)) return std::numeric_limits<double>::infinity();
  const double r = 0.5 * std::abs(b - a) / left;
  if (r < 0.2) {
    const double q = r * r;
    double sum = 0.0;
    for (int n = 10; n > 0; --n) sum = q * (sum + 1.0 / (2.0 * n * (2.0 * n + 1.0)));
    return sum - std::log1p(-middle);
  }
  const auto integral = [](double alpha) {
    return alpha < 1.0 ? (1.0 - alpha) * std::log1p(-alpha) + alpha : 1.0;
  };
  return (integral(b) - integral(a)) / (b - a);
}

}  // namespace triptych::reference
