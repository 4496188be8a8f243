// Draws ray-aligned quads that are evaluated at the domain coordinates of patches. With the other
// APIs, tessellation shaders do that.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_tess(const Session& session, Programs& programs,
                                                     const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::evaluated_quad);
}

}  // namespace triptych::opencl_backend
