#pragma once
#include "backends/gl/api.hpp"
#include "scene/volume.hpp"

namespace triptych::gl_backend {

// Returns the largest error of the device's linear sampler for this format, as a fraction of the
// difference between neighbouring voxels. The probe samples a volume of random zeros and ones in
// the same way as raycast, and compares the samples with interpolation in double precision. Call
// this only if ComputePass::unsupported() returns nullopt, and while a context is current.
[[nodiscard]] double probe_filter(const Api& gl, scene::VoxelFormat format);

}  // namespace triptych::gl_backend
