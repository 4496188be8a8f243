#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/volume.hpp"

namespace triptych::technique {

// Weights of filters have no fewer bits: Vulkan's least subTexelPrecisionBits. OpenGL tells none,
// and its conformance tests take no fewer.
inline constexpr int least_weight_bits = 4;

// The most by which a trilinear filter may err, as a share of the voxels' difference.
//   weights. It snaps to 2^bits places along each axis, rounding or cutting off: by less than a
//     step, by which the value moves along each of three axes.
//   values. The specifications state no precision. What has fewer steps than an image of the
//     format is no filter of it: eight bits for u8. For u16 and f16 we ask for half floats' eleven,
//     for f32 for 24, as Vulkan's conformance tests do for floats of 16 and 32 bits (for eight
//     bits, they leave seven). Each of the three interpolations may round so.
[[nodiscard]] inline double allowed_filter_error(int weight_bits, scene::VoxelFormat format) {
  constexpr std::array<int, 4> value_bits{8, 11, 24, 11};  // by VoxelFormat
  const int bits = value_bits.at(static_cast<std::size_t>(format));
  return 3 * (std::ldexp(1.0, -weight_bits) + std::ldexp(1.0, -bits));
}

}  // namespace triptych::technique
