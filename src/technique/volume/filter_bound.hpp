#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/volume.hpp"

namespace triptych::technique {

// The smallest number of bits of a filter's weights, which is the minimum of Vulkan's
// subTexelPrecisionBits. OpenGL does not report its number; its conformance tests require at least
// as many.
inline constexpr int least_weight_bits = 4;

// The largest error of a trilinear filter, relative to the difference of the voxels.
//
//   - Weights. A filter rounds or truncates the position to one of 2^bits positions along each
//     axis, so the position is off by less than one step. The value changes by that amount along
//     each of three axes.
//   - Values. The specifications state no precision. A filter must at least resolve the steps of
//     its image format: eight bits for u8. For u16 and f16, eleven bits are required, as half
//     floats have. For f32, 24 bits are required. Vulkan's conformance tests require the same for
//     floats of 16 and 32 bits, and seven bits for 8-bit formats. Each of the three interpolations
//     may round by one step.
[[nodiscard]] inline double allowed_filter_error(int weight_bits, scene::VoxelFormat format) {
  constexpr std::array<int, 4> value_bits{8, 11, 24, 11};  // indexed by VoxelFormat
  const int bits = value_bits.at(static_cast<std::size_t>(format));
  return 3 * (std::ldexp(1.0, -weight_bits) + std::ldexp(1.0, -bits));
}

}  // namespace triptych::technique
