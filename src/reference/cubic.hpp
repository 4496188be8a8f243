#pragma once
// A cubic polynomial on [0, 1], and the positions at which its value is an integer. The values are
// positions in the table of the transfer function, so the integers from 0 to 255 are its entries.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "reference/ray.hpp"

namespace triptych::reference {

struct Cubic {
  double c0 = 0;
  double c1 = 0;
  double c2 = 0;
  double c3 = 0;

  // Returns the cubic with these values at 0, 1/3, 2/3 and 1.
  [[nodiscard]] static Cubic through(const std::array<double, 4>& f) {
    return {f[0], (-11.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / 2.0,
            9.0 * (2.0 * f[0] - 5.0 * f[1] + 4.0 * f[2] - f[3]) / 2.0,
            9.0 * (-f[0] + 3.0 * f[1] - 3.0 * f[2] + f[3]) / 2.0};
  }

  // Returns the cubic in s that interpolates value(position in voxels) along a ray. s = 0 is at
  // distance `begin` and s = 1 at distance `end`.
  template <typename Value>
  [[nodiscard]] static Cubic along(const Ray& ray, double begin, double end, const Value& value) {
    std::array<double, 4> f;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double t = begin + (end - begin) * static_cast<double>(i) / 3.0;
      f[i] = value(ray.entry + t * ray.voxels_per_unit);
    }
    return through(f);
  }

  [[nodiscard]] double operator()(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }

  [[nodiscard]] double slope(double s) const { return c1 + s * (2.0 * c2 + s * 3.0 * c3); }

  // Appends every s in (0, 1), in ascending order, where the cubic passes one of the integers 0, 1,
  // …, 255 for which `keep` returns true.
  template <typename Keep>
  void append_knots(std::vector<double>& at, Keep keep) const {
    const std::array<double, 4> ends = monotone_ends();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double lo = (*this)(ends[i]);
      const double hi = (*this)(ends[i + 1]);
      const double first = std::max(std::ceil(std::min(lo, hi)), 0.0);
      const double last = std::min(std::floor(std::max(lo, hi)), 255.0);
      for (double n = 0.0; n <= last - first; n += 1.0) {
        const double knot = lo < hi ? first + n : last - n;
        if (keep(knot)) at.push_back(solve(knot, ends[i], ends[i + 1]));
      }
    }
  }
  void append_knots(std::vector<double>& at) const {
    append_knots(at, [](double) { return true; });
  }

  // Returns 0, the extrema in (0, 1), and 1, in ascending order. If there are fewer than two
  // extrema, 0 or 1 is repeated.
  [[nodiscard]] std::array<double, 4> monotone_ends() const {
    std::array<double, 4> ends{0.0, 0.0, 1.0, 1.0};
    const double half = c2;  // the extrema solve c1 + 2·half·s + 3·c3·s² = 0
    const double discriminant = half * half - 3.0 * c3 * c1;
    if (discriminant > 0.0) {
      // q is a sum of two numbers with the same sign, so neither root suffers from cancellation.
      const double q = -(half + std::copysign(std::sqrt(discriminant), half));
      double a = c3 != 0.0 ? q / (3.0 * c3) : 0.0;
      double b = q != 0.0 ? c1 / q : 0.0;
      if (a > b) std::swap(a, b);
      ends[1] = std::clamp(a, 0.0, 1.0);
      ends[2] = std::clamp(b, 0.0, 1.0);
    }
    return ends;
  }

 private:
  // Returns the position at which the cubic has this value, in an interval from a to b on which the
  // cubic is monotone. Bisects the interval down to 2⁻⁴⁰ of its length.
  [[nodiscard]] double solve(double value, double a, double b) const {
    const bool rising = (*this)(a) < (*this)(b);
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (a + b);
      if (((*this)(middle) < value) == rising) {
        a = middle;
      } else {
        b = middle;
      }
    }
    return 0.5 * (a + b);
  }
};

}  // namespace triptych::reference
