#include "reference/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace triptych::reference {

using std::numbers::inv_sqrtpi;
using std::numbers::pi;
using std::numbers::sqrt2;

Radiance over(const Radiance& front, const Radiance& behind) {
  const double left = 1.0 - front.opacity;
  return {front.colour + left * behind.colour, front.opacity + left * behind.opacity};
}

Radiance v1_constant(double tau, double colour, double length) {
  const double opacity = -std::expm1(-tau * length);
  return {colour * opacity, opacity};
}

Radiance v2_ramp(double k) {
  return v3_segment({0.0, k, 0.0, 1.0, 1.0});
}

Radiance v3_segment(const LinearSegment& s) {
  const double depth = s.length * (s.tau0 + 0.5 * s.tau1 * s.length);
  const double opacity = -std::expm1(-depth);
  // The formula in closed_forms.hpp contains −(c₀+c₁l)·E(l) + c₀, where l is the length and E(l)
  // the transmittance. It is computed as c₀·A − c₁·l·E(l) with the opacity A = 1 − E(l), because
  // the first form would suffer from cancellation.
  const double integral = transmittance_integral(s.tau0, s.tau1, s.length);
  const double colour = s.colour0 * opacity + s.colour1 * (integral - s.length * std::exp(-depth));
  return {colour, opacity};
}

namespace {

// Computes transmittance_integral() by the Taylor series of the transmittance E = Σ eₙ·tⁿ. The
// differential equation E' = −(a + bt)·E gives the Taylor coefficients (n+1)·eₙ₊₁ = −a·eₙ − b·eₙ₋₁.
// The code computes these coefficients multiplied by lengthⁿ.
double taylor_integral(double a, double b, double length) {
  const double x = a * length;
  const double y = b * length * length;
  double previous = 0.0;
  double current = 1.0;
  double sum = 1.0;
  for (int n = 0; n < 60; ++n) {
    const double next = (-x * current - y * previous) / (n + 1);
    previous = current;
    current = next;
    sum += current / (n + 2);
    if (std::abs(current) + std::abs(previous) < 1e-19) break;
  }
  return sum * length;
}

}  // namespace

double transmittance_integral(double a, double b, double length) {
  const double x = a * length;
  const double y = b * length * length;
  if (std::max(std::abs(x), std::abs(y)) <= 1.0) return taylor_integral(a, b, length);
  // The segment is optically thick here, so neither difference below suffers from cancellation.
  const double left = std::exp(-x - 0.5 * y);
  if (std::abs(y) <= 1e-17 * x) return (1.0 - left) / a;
  const double end = std::max(a + b * length, 0.0);
  const double width = std::sqrt(2.0 * std::abs(b));
  if (b > 0.0) return std::sqrt(pi) / width * (erfcx(a / width) - left * erfcx(end / width));
  return 2.0 / width * (dawson(a / width) - left * dawson(end / width));
}

double v4_gaussian_depth(double tau0, double sigma, double p, double s0, double s1) {
  const double whole = tau0 * sigma * std::sqrt(pi / 2) * std::exp(-0.5 * p * p / (sigma * sigma));
  return whole * (std::erf(s1 / (sqrt2 * sigma)) - std::erf(s0 / (sqrt2 * sigma)));
}

double v5_atmosphere_depth(double tau0, double scale_height, double z0, double z1, double cosine) {
  const double low = std::min(z0, z1) / scale_height;
  const double rise = std::abs(z1 - z0) / scale_height;
  return tau0 * scale_height * std::exp(-low) * -std::expm1(-rise) / std::abs(cosine);
}

Radiance v6_layers(double tau1, double colour1, double length1, double tau2, double colour2,
                   double length2) {
  return over(v1_constant(tau1, colour1, length1), v1_constant(tau2, colour2, length2));
}

double v9_difference_factor(double k, double delta) {
  return std::sin(k * delta) / (k * delta);
}

namespace {

// Returns ∫ cos(phase + rate·t)·τ·e^(−τt) dt over [0, length].
double lit_cosine(double tau, double phase, double rate, double length) {
  const std::complex<double> exponent{-tau, rate};
  const std::complex<double> integral =
      std::polar(1.0, phase) * (std::exp(exponent * length) - 1.0) / exponent;
  return tau * integral.real();
}

}  // namespace

double v9_lit_wave(double tau, int power, double phase, double rate, double length) {
  if (power == 1) return lit_cosine(tau, phase - pi / 2, rate, length);
  // For even n, sinⁿx = 2⁻ⁿ·[C(n, n/2) + 2·Σ (−1)ʲ·C(n, n/2 − j)·cos 2jx] with j = 1 … n/2, where
  // C are the binomial coefficients. Each cosine is integrated separately.
  double binomial = 1.0;  // C(n, k), with n = power
  double sum = 0.0;
  for (int k = 0; k <= power / 2; ++k) {
    const int j = power / 2 - k;
    const double cosine = lit_cosine(tau, 2 * j * phase, 2 * j * rate, length);
    sum += (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 ? 1.0 : 2.0) * binomial * cosine;
    binomial *= static_cast<double>(power - k) / (k + 1);
  }
  return std::ldexp(sum, -power);
}

double erfcx(double x) {
  if (x < 2.0) return std::exp(x * x) * std::erfc(x);
  // Laplace's continued fraction for erfcx(x) is
  //   1/(√π·(x + (1/2)/(x + (2/2)/(x + (3/2)/(x + …))))).
  // It is evaluated from its innermost level outwards. For x ≥ 2, 160 levels give full precision;
  // larger x need fewer.
  double tail = x;
  for (int n = 160; n > 0; --n) tail = x + 0.5 * n / tail;
  return inv_sqrtpi / tail;
}

double dawson(double x) {
  const double size = std::abs(x);
  if (size < 1.0) {
    // For |x| < 1, the power series of Dawson's function, Σ (−2)ⁿ·x^(2n+1)/(2n+1)!!, converges
    // quickly.
    double term = x;
    double sum = x;
    for (int n = 1; n < 40 && std::abs(term) > 1e-18 * std::abs(sum); ++n) {
      term *= -2.0 * x * x / (2 * n + 1);
      sum += term;
    }
    return sum;
  }
  // For a small h, Dawson's function is approximately (1/√π)·Σ e^(−(x−nh)²)/n, summed over all odd
  // n (Rybicki, Computers in Physics 3, 1989). The error is e^(−(π/(2h))²) = 7e-18 for h = 1/4.
  // Terms with |x − nh| > 6.5 are below 5e-19 and are left out.
  constexpr double h = 0.25;
  const double centre = std::floor(size / h);
  double sum = 0.0;
  for (int offset = -26; offset <= 27; ++offset) {
    const double n = centre + offset;
    if (std::fmod(std::abs(n), 2.0) != 1.0) continue;
    const double distance = size - n * h;
    sum += std::exp(-distance * distance) / n;
  }
  return std::copysign(sum * inv_sqrtpi, x);
}

}  // namespace triptych::reference
