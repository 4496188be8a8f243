// Screen-aligned quads around the silhouettes, which other APIs make in a geometry shader.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_screen(const Session& session, Programs& programs,
                                                       const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::screen_quad);
}

}  // namespace triptych::opencl_backend
