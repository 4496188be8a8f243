#pragma once
// IEEE 754 binary16 ("half") floats: 11 significant bits, normal values from 2⁻¹⁴ to 65504.

#include <cstdint>

namespace triptych::scene {

struct Half {
  std::uint16_t bits = 0;
  explicit operator double() const;
};

inline constexpr double largest_half = 65504;
// The smallest normal half. Smaller magnitudes are subnormal, and devices may treat them as 0.
inline constexpr double least_normal_half = 0x1.0p-14;
// The largest relative error of rounding a normal value to the nearest half.
inline constexpr double half_roundoff = 0x1.0p-11;

// Returns the nearest half. Ties are rounded to even, and values of 65520 or more become infinity.
[[nodiscard]] Half to_half(double value);

}  // namespace triptych::scene
