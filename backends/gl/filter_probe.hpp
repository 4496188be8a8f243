#pragma once
#include "backends/gl/api.hpp"
#include "scene/volume.hpp"

namespace triptych::gl_backend {

// The largest error of the device's linear sampler for this format, as a share of the difference
// between neighbouring voxels. It fetches from a volume of random zeros and ones as raycast does,
// and compares with interpolation in double precision. It needs what ComputePass::unsupported asks
// for, and a current context.
[[nodiscard]] double probe_filter(const Api& gl, scene::VoxelFormat format);

}  // namespace triptych::gl_backend
