#pragma once
// Computes the order of convergence from a series of errors.

#include <cmath>
#include <cstddef>
#include <vector>

namespace triptych::test {

// Returns the least-squares slope of log(error) over log(size), where the size is a step size or
// voxel size.
inline double fitted_order(const std::vector<double>& sizes, const std::vector<double>& errors) {
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double x = std::log(sizes[i]);
    const double y = std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto n = static_cast<double>(sizes.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace triptych::test
