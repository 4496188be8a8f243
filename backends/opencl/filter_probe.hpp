#pragma once
#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "scene/volume.hpp"

namespace triptych::opencl_backend {

// Returns the largest error of the device's trilinear sampler at seeded random positions, as a
// fraction of the difference between neighbouring voxels. In this probe, that difference is the
// whole range of the format. Throws core::NotSupported if the device has no image format for these
// voxels.
[[nodiscard]] double probe_filter(const Session& session, Programs& programs,
                                  scene::VoxelFormat format);

}  // namespace triptych::opencl_backend
