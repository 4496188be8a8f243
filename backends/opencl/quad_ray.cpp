// Quads across the ray to the centre, whose vertices a pass of its own writes: what a geometry shader
// does elsewhere.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_ray(const Session& session, Programs& programs,
                                                    const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::expanded_quad);
}

}  // namespace triptych::opencl_backend
