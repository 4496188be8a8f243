#pragma once
#include "backends/opencl/objects.hpp"
#include "backends/opencl/programs.hpp"
#include "scene/volume.hpp"

namespace triptych::opencl_backend {

// Largest error of the device's trilinear sampler over seeded random places, as a share of the
// difference between neighbouring voxels, which here is the format's whole range.
// Throws core::NotSupported where the device has no image format for these voxels.
[[nodiscard]] double probe_filter(const Session& session, Programs& programs,
                                  scene::VoxelFormat format);

}  // namespace triptych::opencl_backend
