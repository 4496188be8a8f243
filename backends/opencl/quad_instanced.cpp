// Ray-aligned quads as instances. Without a vertex stage these are the sprites of quad_ray, made
// from the same buffers.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_instanced(const Session& session,
                                                          Programs& programs,
                                                          const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::ray_quad);
}

}  // namespace triptych::opencl_backend
