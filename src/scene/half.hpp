#pragma once
// Half floats, IEEE 754 binary16: 11 significant bits, 2⁻¹⁴ (normal) … 65504.

#include <cstdint>

namespace triptych::scene {

struct Half {
  std::uint16_t bits = 0;
  explicit operator double() const;
};

inline constexpr double largest_half = 65504;
// Below, halves are subnormal, and devices may take those for 0.
inline constexpr double least_normal_half = 0x1.0p-14;
// What rounding to the nearest half is off by at most, relative, from the least normal one on.
inline constexpr double half_roundoff = 0x1.0p-11;

// The nearest, ties to even; from 65520 on infinity.
[[nodiscard]] Half to_half(double value);

}  // namespace triptych::scene
