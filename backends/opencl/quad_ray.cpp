// Draws ray-aligned quads whose vertices are written by a separate pass. With the other APIs, a
// geometry shader generates them.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_ray(const Session& session, Programs& programs,
                                                    const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::expanded_quad);
}

}  // namespace triptych::opencl_backend
