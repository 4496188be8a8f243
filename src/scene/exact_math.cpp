#include "scene/exact_math.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace triptych::scene {
namespace {

// Evaluates a Taylor polynomial by Horner's method. The compiler rounds the coefficients correctly,
// because each is written as a quotient of two integers.
template <std::size_t N>
double horner(const std::array<double, N>& coefficients, double x) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

// The series for sine and cosine are used only for |x| ≤ π/4, where the first omitted term is below
// 2⁻⁵⁶.
double sine_series(double x) {
  static constexpr std::array<double, 9> c{1.0,
                                           -1.0 / 6,
                                           1.0 / 120,
                                           -1.0 / 5040,
                                           1.0 / 362880,
                                           -1.0 / 39916800,
                                           1.0 / 6227020800,
                                           -1.0 / 1307674368000,
                                           1.0 / 355687428096000};
  return x * horner(c, x * x);
}

double cosine_series(double x) {
  static constexpr std::array<double, 9> c{1.0,
                                           -1.0 / 2,
                                           1.0 / 24,
                                           -1.0 / 720,
                                           1.0 / 40320,
                                           -1.0 / 3628800,
                                           1.0 / 479001600,
                                           -1.0 / 87178291200,
                                           1.0 / 20922789888000};
  return horner(c, x * x);
}

// Returns the sine for 0 ≤ turns ≤ ¼.
double sine_of_quarter(double turns) {
  constexpr double tau = 2 * std::numbers::pi;
  return turns <= 0.125 ? sine_series(tau * turns) : cosine_series(tau * (0.25 - turns));
}

}  // namespace

double sine_turns(double turns) {
  const double t = turns - std::floor(turns + 0.5);  // −½ ≤ t < ½
  const double magnitude = std::abs(t);
  const double value = sine_of_quarter(magnitude <= 0.25 ? magnitude : 0.5 - magnitude);
  return t < 0 ? -value : value;
}

double cosine_turns(double turns) {
  const double magnitude = std::abs(turns - std::floor(turns + 0.5));  // 0 … ½
  return magnitude <= 0.25 ? sine_of_quarter(0.25 - magnitude) : -sine_of_quarter(magnitude - 0.25);
}

double exponential(double x) {
  static constexpr std::array<double, 15> c{1.0,
                                            1.0,
                                            1.0 / 2,
                                            1.0 / 6,
                                            1.0 / 24,
                                            1.0 / 120,
                                            1.0 / 720,
                                            1.0 / 5040,
                                            1.0 / 40320,
                                            1.0 / 362880,
                                            1.0 / 3628800,
                                            1.0 / 39916800,
                                            1.0 / 479001600,
                                            1.0 / 6227020800,
                                            1.0 / 87178291200};
  if (x < -700) return 0;
  const double k = std::floor(x / std::numbers::ln2 + 0.5);
  return std::ldexp(horner(c, x - k * std::numbers::ln2), static_cast<int>(k));
}

double logarithm(double x) {
  // Writes x as m·2^e with m between √½ and √2, so that ln x = ln m + e·ln 2. Here, ln m is
  // 2·artanh s with s = (m − 1)/(m + 1). The series of artanh s converges quickly, because
  // |s| < 0.172.
  static constexpr std::array<double, 11> c{1.0,      1.0 / 3,  1.0 / 5,  1.0 / 7,
                                            1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                                            1.0 / 17, 1.0 / 19, 1.0 / 21};
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < 1 / std::numbers::sqrt2) {
    m *= 2;
    e -= 1;
  }
  const double s = (m - 1) / (m + 1);
  return 2 * s * horner(c, s * s) + e * std::numbers::ln2;
}

double logarithm_of_1_plus(double x) {
  if (x <= -1) return -std::numeric_limits<double>::infinity();
  // The factor x/(sum − 1) corrects the rounding error of 1 + x (Kahan).
  const double sum = 1 + x;
  return sum == 1 ? x : logarithm(sum) * (x / (sum - 1));
}

}  // namespace triptych::scene
