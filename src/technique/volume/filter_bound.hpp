#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/volume.hpp"

namespace triptych::technique {

// The smallest number of bits of a filter's weights: the minimum of Vulkan's subTexelPrecisionBits.
// OpenGL does not report it, and its conformance tests accept no fewer.
inline constexpr int least_weight_bits = 4;

// The largest error of a trilinear filter, as a share of the difference of the voxels.
//
//   - Weights. A filter snaps to 2^bits positions along each axis, by rounding or truncation, so by
//     less than one step. The value changes by that along each of three axes.
//   - Values. The specifications state no precision. A filter with fewer steps than an image of the
//     format is not a filter for it: eight bits for u8. For u16 and f16 eleven bits are required,
//     as half floats have, and for f32 24, as Vulkan's conformance tests do for floats of 16 and 32
//     bits (for eight bits they require seven). Each of the three interpolations may round by that.
[[nodiscard]] inline double allowed_filter_error(int weight_bits, scene::VoxelFormat format) {
  constexpr std::array<int, 4> value_bits{8, 11, 24, 11};  // indexed by VoxelFormat
  const int bits = value_bits.at(static_cast<std::size_t>(format));
  return 3 * (std::ldexp(1.0, -weight_bits) + std::ldexp(1.0, -bits));
}

}  // namespace triptych::technique
