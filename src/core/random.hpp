#pragma once
// A random number generator that produces the same sequence on every machine and with every
// standard library. The distributions of <random> are not used, because their algorithms depend on
// the implementation.

#include <cstdint>

namespace triptych::core {

// SplitMix64 (Steele, Lea, Flood 2014): one 64-bit state, equidistributed, passes BigCrush.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  // Returns a number that is uniformly distributed in [0, 1), with 53 random bits.
  [[nodiscard]] constexpr double uniform() noexcept {
    return static_cast<double>(bits() >> 11) * 0x1.0p-53;
  }

  // Returns a number that is uniformly distributed in [lo, hi).
  [[nodiscard]] constexpr double uniform(double lo, double hi) noexcept {
    return lo + (hi - lo) * uniform();
  }

 private:
  std::uint64_t state_;
};

}  // namespace triptych::core
