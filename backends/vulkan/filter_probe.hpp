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

// technique::allowed_filter_error, of the weights that the device tells.
[[nodiscard]] double allowed_filter_error(const Gpu& gpu, scene::VoxelFormat format);

}  // namespace triptych::vulkan_backend
