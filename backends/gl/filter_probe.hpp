#pragma once
#include "backends/gl/api.hpp"
#include "scene/volume.hpp"

namespace triptych::gl_backend {

// Largest error of the device's linear sampler in this format, as a share of the difference between
// neighbouring voxels: fetches a volume of random zeros and ones as raycast does and compares with
// interpolation in double precision. Needs what ComputePass::unsupported asks for. The context is
// current.
[[nodiscard]] double probe_filter(const Api& gl, scene::VoxelFormat format);

}  // namespace triptych::gl_backend
