#include "judge/regression.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "judge/statistics.hpp"

namespace triptych::judge {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Sums of squares and products about the means: two passes, so that large means cost no digits.
struct Moments {
  double mean_x, mean_y, xx = 0, xy = 0, yy = 0;

  Moments(std::span<const double> x, std::span<const double> y) : mean_x(mean(x)), mean_y(mean(y)) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mean_x) * (x[i] - mean_x);
      xy += (x[i] - mean_x) * (y[i] - mean_y);
      yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
  }
  [[nodiscard]] double r() const {
    return xx > 0 && yy > 0 ? std::clamp(xy / std::sqrt(xx) / std::sqrt(yy), -1.0, 1.0)
                            : not_a_number;
  }
};

}  // namespace

double pearson_r(std::span<const double> x, std::span<const double> y) {
  return Moments(x, y).r();
}

Line least_squares(std::span<const double> x, std::span<const double> y) {
  const Moments moments(x, y);
  if (!(moments.xx > 0)) return {not_a_number, not_a_number, not_a_number, not_a_number};
  Line line;
  line.slope = moments.xy / moments.xx;
  line.intercept = moments.mean_y - line.slope * moments.mean_x;
  line.r = moments.r();
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - line.intercept - line.slope * x[i];
    squares += residual * residual;
  }
  line.residual_scale =
      x.size() > 2 ? std::sqrt(squares / static_cast<double>(x.size() - 2)) : not_a_number;
  return line;
}

}  // namespace triptych::judge
