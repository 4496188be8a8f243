// Ray-aligned quads whose vertices a separate pass writes, as a geometry shader does on the other
// APIs.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_ray(const Session& session, Programs& programs,
                                                    const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::expanded_quad);
}

}  // namespace triptych::opencl_backend
