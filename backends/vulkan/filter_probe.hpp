#pragma once
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "scene/volume.hpp"

namespace triptych::vulkan_backend {

// Whether images of this format can be sampled with linear filtering.
[[nodiscard]] bool can_sample(const Gpu& gpu, scene::VoxelFormat format);
[[nodiscard]] bool can_filter(const Gpu& gpu, scene::VoxelFormat format);

// The largest error of the device's trilinear filter at some thousand random positions among random
// black and white voxels. It is compared with double precision and given as a share of the
// difference of the voxels. Empty if the format cannot be filtered.
[[nodiscard]] std::optional<double> probe_filter(const Gpu& gpu, scene::VoxelFormat format);

// technique::allowed_filter_error for the precision of the weights that the device reports.
[[nodiscard]] double allowed_filter_error(const Gpu& gpu, scene::VoxelFormat format);

}  // namespace triptych::vulkan_backend
