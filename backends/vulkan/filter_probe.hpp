#pragma once
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "scene/volume.hpp"

namespace triptych::vulkan_backend {

// can_sample() returns whether the device can sample images of this format, and can_filter()
// whether it can do so with linear filtering.
[[nodiscard]] bool can_sample(const Gpu& gpu, scene::VoxelFormat format);
[[nodiscard]] bool can_filter(const Gpu& gpu, scene::VoxelFormat format);

// Returns the largest error of the device's trilinear filter, found at several thousand random
// positions in a volume of random black and white voxels. The error is measured against double
// precision, and is a fraction of the difference between black and white. Returns nullopt if the
// format cannot be filtered.
[[nodiscard]] std::optional<double> probe_filter(const Gpu& gpu, scene::VoxelFormat format);

// Returns technique::allowed_filter_error for the weight precision that the device reports.
[[nodiscard]] double allowed_filter_error(const Gpu& gpu, scene::VoxelFormat format);

}  // namespace triptych::vulkan_backend
