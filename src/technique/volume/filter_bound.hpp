#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/volume.hpp"

namespace triptych::technique {

// The minimum precision of a filter's weights, in bits. This is the minimum that Vulkan requires
// for subTexelPrecisionBits. OpenGL does not report the precision, but its conformance tests
// require at least as many bits.
inline constexpr int least_weight_bits = 4;

// Returns the maximum permitted error of a trilinear filter, relative to the largest difference
// between the voxels that it interpolates.
//
//   - Weights. A filter rounds or truncates the position to one of 2^bits positions along each
//     axis, so the position is off by less than one step along each of three axes. The value
//     changes in proportion.
//   - Values. The specifications do not require any precision. A filter should at least resolve the
//     steps of its image format: 8 bits are required for u8, 11 bits (the precision of half floats)
//     for u16 and f16, and 24 bits for f32. Vulkan's conformance tests require the same for floats
//     of 16 and 32 bits, and seven bits for 8-bit formats. Each of the three interpolations may
//     round by one step.
[[nodiscard]] inline double allowed_filter_error(int weight_bits, scene::VoxelFormat format) {
  constexpr std::array<int, 4> value_bits{8, 11, 24, 11};  // indexed by VoxelFormat
  const int bits = value_bits.at(static_cast<std::size_t>(format));
  return 3 * (std::ldexp(1.0, -weight_bits) + std::ldexp(1.0, -bits));
}

}  // namespace triptych::technique
