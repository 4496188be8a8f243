// Draws ray-aligned quads. OpenCL has no rasterizer stages, so several techniques that draw such
// quads share this implementation.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_instanced(const Session& session,
                                                          Programs& programs,
                                                          const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::ray_quad);
}

}  // namespace triptych::opencl_backend
