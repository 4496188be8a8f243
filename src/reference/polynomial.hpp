#pragma once
// Finds the sign changes of a polynomial Σ cₖ·sᵏ on [0, 1].

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace triptych::reference {

template <std::size_t N>
[[nodiscard]] double value_of(const std::array<double, N>& c, double s) {
  double value = 0.0;
  for (std::size_t k = N; k-- > 0;) value = value * s + c[k];
  return value;
}

// Returns whether all Bernstein coefficients, which enclose the polynomial, have the same sign. The
// polynomial then has no root.
template <std::size_t N>
[[nodiscard]] bool has_one_sign(const std::array<double, N>& c) {
  bool positive = true;
  bool negative = true;
  for (std::size_t j = 0; j < N; ++j) {
    double sum = 0.0;
    double share = 1.0;  // a ratio of binomial coefficients, C(j, k)/C(N − 1, k)
    for (std::size_t k = 0; k <= j; ++k) {
      sum += share * c[k];
      share *=
          static_cast<double>(j - k) / static_cast<double>(std::max<std::size_t>(N - 1 - k, 1));
    }
    positive = positive && sum > 0.0;
    negative = negative && sum < 0.0;
  }
  return positive || negative;
}

// Appends every s in (0, 1) where the sign changes, in ascending order. Between two extrema, which
// are the roots of the derivative, the sign changes at most once. This change is found by bisection
// down to 2⁻⁵⁰.
template <std::size_t N>
void append_roots(const std::array<double, N>& c, std::vector<double>& at) {
  if constexpr (N > 1) {
    if (has_one_sign(c)) return;
    std::array<double, N - 1> derivative;
    for (std::size_t k = 1; k < N; ++k) derivative[k - 1] = static_cast<double>(k) * c[k];
    std::vector<double> ends{0.0};
    append_roots(derivative, ends);
    ends.push_back(1.0);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      double a = ends[i];
      double b = ends[i + 1];
      const bool rising = value_of(c, a) < 0.0;
      if (rising == (value_of(c, b) < 0.0)) continue;
      for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (a + b);
        ((value_of(c, middle) < 0.0) == rising ? a : b) = middle;
      }
      at.push_back(0.5 * (a + b));
    }
  }
}

}  // namespace triptych::reference
