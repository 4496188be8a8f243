#include "analysis/kolmogorov.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/random.hpp"

namespace triptych::analysis {
namespace {

// Beyond these Durbin's matrix is larger than its extra digits are worth.
constexpr std::size_t most_for_matrix = 10000;
constexpr std::size_t most_cells_for_counting = 4'000'000;

// A square matrix of positive numbers times 10^exponent, so that powers do not overflow.
class Scaled {
 public:
  explicit Scaled(std::size_t size) : size_(size), cells_(size * size) {}
  double& at(std::size_t row, std::size_t column) { return cells_[row * size_ + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return cells_[row * size_ + column];
  }
  [[nodiscard]] int exponent() const { return exponent_; }

  [[nodiscard]] Scaled times(const Scaled& other) const {
    Scaled result(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < size_; ++k) {
        const double factor = at(i, k);
        if (factor == 0) continue;
        for (std::size_t j = 0; j < size_; ++j) result.at(i, j) += factor * other.at(k, j);
      }
    }
    result.exponent_ = exponent_ + other.exponent_;
    if (result.at(size_ / 2, size_ / 2) > 1e140) {
      for (double& cell : result.cells_) cell *= 1e-140;
      result.exponent_ += 140;
    }
    return result;
  }

 private:
  std::size_t size_;
  std::vector<double> cells_;
  int exponent_ = 0;
};

Scaled power(const Scaled& base, std::size_t n) {
  if (n == 1) return base;
  const Scaled half = power(base, n / 2);
  const Scaled square = half.times(half);
  return n % 2 == 0 ? square : square.times(base);
}

// Durbin's matrix H for n·d = k − h, 0 ≤ h < 1.
Scaled durbin_matrix(std::size_t size, double h) {
  Scaled matrix(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) matrix.at(i, j) = i + 1 < j ? 0 : 1;
  }
  const auto exponent = [](std::size_t value) { return static_cast<double>(value); };
  for (std::size_t i = 0; i < size; ++i) {
    matrix.at(i, 0) -= std::pow(h, exponent(i + 1));
    matrix.at(size - 1, i) -= std::pow(h, exponent(size - i));
  }
  if (2 * h > 1) matrix.at(size - 1, 0) += std::pow(2 * h - 1, exponent(size));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= std::min(i + 1, size - 1); ++j) {
      for (std::size_t g = 2; g <= i + 1 - j; ++g) matrix.at(i, j) /= exponent(g);
    }
  }
  return matrix;
}

double durbin_below(std::size_t n, double d) {
  const double nd = static_cast<double>(n) * d;
  const double k = std::floor(nd) + 1;
  const auto size = static_cast<std::size_t>(2 * k - 1);
  const Scaled to_n = power(durbin_matrix(size, k - nd), n);
  const auto middle = static_cast<std::size_t>(k) - 1;
  double s = to_n.at(middle, middle);
  int exponent = to_n.exponent();
  for (std::size_t i = 1; i <= n; ++i) {  // × n!/nⁿ
    s *= static_cast<double>(i) / static_cast<double>(n);
    if (s < 1e-140) {
      s *= 1e140;
      exponent -= 140;
    }
  }
  return s * std::pow(10.0, exponent);
}

double stephens(double effective_n, double d) {
  const double root = std::sqrt(effective_n);
  return kolmogorov_limit_above((root + 0.12 + 0.11 / root) * d);
}

// P(D < d) of two samples by counting lattice paths from (0, 0) to (n, m) that stay closer than d
// to the diagonal, as a share of all: each step is taken with the probability that the order of a
// joint sample gives it.
double exact_two_samples_below(std::size_t n, std::size_t m, double d) {
  const double dn = static_cast<double>(n);
  const double dm = static_cast<double>(m);
  // D is a multiple of 1/lcm(n, m); half of 1/(nm) keeps rounding from moving it.
  const double limit = d - 0.5 / (dn * dm);
  std::vector<double> row(m + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= m; ++j) {
      const double di = static_cast<double>(i);
      const double dj = static_cast<double>(j);
      if (std::abs(di / dn - dj / dm) > limit) {
        row[j] = 0;
      } else if (i == 0 && j == 0) {
        row[j] = 1;
      } else {
        // The last of i + j drawn is of the first sample with probability i/(i + j).
        const double from_a = i > 0 ? row[j] * di / (di + dj) : 0;
        const double from_b = j > 0 ? row[j - 1] * dj / (di + dj) : 0;
        row[j] = from_a + from_b;
      }
    }
  }
  return row[m];
}

double normal_draw(core::Random& random) {
  const double radius = std::sqrt(-2 * std::log1p(-random.uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

}  // namespace

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double kolmogorov_limit_above(double x) {
  if (!(x > 0)) return 1;
  if (x < 1.18) {  // the other series converges fast here
    const double y = std::exp(-std::numbers::pi * std::numbers::pi / (8 * x * x));
    const double sum = y + std::pow(y, 9) + std::pow(y, 25) + std::pow(y, 49);
    return 1 - std::sqrt(2 * std::numbers::pi) / x * sum;
  }
  double sum = 0;
  double sign = 1;
  for (int k = 1; k <= 100; ++k, sign = -sign) {
    const double term = std::exp(-2.0 * k * k * x * x);
    sum += sign * term;
    if (term < 1e-18 * sum) break;
  }
  return std::clamp(2 * sum, 0.0, 1.0);
}

double kolmogorov_below(std::size_t n, double d) {
  if (!(d > 0) || n == 0) return 0;
  if (d >= 1) return 1;
  const double squares = d * d * static_cast<double>(n);
  // In the tail the limit is good to many digits, and 1 − (1 − p) would keep few of them anyway.
  if (squares > 7.24 || (squares > 3.76 && n > 99) || n > most_for_matrix) {
    return 1 - stephens(static_cast<double>(n), d);
  }
  return std::clamp(durbin_below(n, d), 0.0, 1.0);
}

KsTest ks_one_sample(std::span<const double> sample,
                     const std::function<double(double)>& cumulative) {
  std::vector<double> sorted(sample.begin(), sample.end());
  std::ranges::sort(sorted);
  const double n = static_cast<double>(sorted.size());
  KsTest test;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double f = cumulative(sorted[i]);
    const double di = static_cast<double>(i);
    test.d = std::max({test.d, f - di / n, (di + 1) / n - f});
  }
  const double squares = test.d * test.d * n;
  // Small p straight from the limit: 1 − P(D < d) has none of its digits.
  test.p = squares > 3.76 ? stephens(n, test.d) : 1 - kolmogorov_below(sorted.size(), test.d);
  return test;
}

KsTest ks_two_samples(std::span<const double> a, std::span<const double> b) {
  std::vector<double> x(a.begin(), a.end());
  std::vector<double> y(b.begin(), b.end());
  std::ranges::sort(x);
  std::ranges::sort(y);
  const double n = static_cast<double>(x.size());
  const double m = static_cast<double>(y.size());
  KsTest test;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < x.size() && j < y.size()) {
    const double here = std::min(x[i], y[j]);
    while (i < x.size() && x[i] == here) ++i;
    while (j < y.size() && y[j] == here) ++j;
    test.d = std::max(test.d, std::abs(static_cast<double>(i) / n - static_cast<double>(j) / m));
  }
  const double effective = n * m / (n + m);
  const bool far_in_the_tail = test.d * test.d * effective > 7.24;
  test.p = far_in_the_tail || x.size() * y.size() > most_cells_for_counting
               ? stephens(effective, test.d)
               : std::clamp(1 - exact_two_samples_below(x.size(), y.size(), test.d), 0.0, 1.0);
  return test;
}

double lilliefors_p(double d, std::size_t n, std::size_t replicates, std::uint64_t seed) {
  core::Random random(seed);
  std::vector<double> sample(n);
  std::size_t as_large = 0;
  for (std::size_t replicate = 0; replicate < replicates; ++replicate) {
    double sum = 0;
    for (double& value : sample) sum += value = normal_draw(random);
    const double mean = sum / static_cast<double>(n);
    double squares = 0;
    for (const double value : sample) squares += (value - mean) * (value - mean);
    const double deviation = std::sqrt(squares / static_cast<double>(n));
    std::ranges::sort(sample);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double f = normal_below((sample[i] - mean) / deviation);
      const double di = static_cast<double>(i);
      largest = std::max(
          {largest, f - di / static_cast<double>(n), (di + 1) / static_cast<double>(n) - f});
    }
    if (largest >= d) ++as_large;
  }
  return static_cast<double>(1 + as_large) / static_cast<double>(1 + replicates);
}

}  // namespace triptych::analysis
