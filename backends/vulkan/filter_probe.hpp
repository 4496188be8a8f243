#pragma once
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "scene/volume.hpp"

namespace triptych::vulkan_backend {

// Whether images of this format can be sampled, and filtered linearly.
[[nodiscard]] bool can_sample(const Gpu& gpu, scene::VoxelFormat format);
[[nodiscard]] bool can_filter(const Gpu& gpu, scene::VoxelFormat format);

// The largest error of the device's trilinear filter over some thousand random places among random
// black and white voxels, against double precision, as a share of the voxels' difference. Absent
// where the format cannot be filtered.
[[nodiscard]] std::optional<double> probe_filter(const Gpu& gpu, scene::VoxelFormat format);

// The most that the API leaves open, as a share of the voxels' difference.
//   weights. The filter snaps to 2^subTexelPrecisionBits places along each axis, rounding or
//   cutting
//     off: by less than a step, by which the value moves along each of three axes.
//   values. The specification states no precision. What has fewer steps than an image of the format
//     is no filter of it: eight bits for u8. For u16 we ask for half floats' eleven, for f32 for
//     24, as the API's conformance tests do for floats of 16 and 32 bits (for eight bits, they
//     leave seven). Each of the three interpolations may round so.
[[nodiscard]] double allowed_filter_error(const Gpu& gpu, scene::VoxelFormat format);

}  // namespace triptych::vulkan_backend
