// Draws screen-aligned quads around the silhouettes. With the other APIs, a geometry shader
// generates them.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_quad_screen(const Session& session, Programs& programs,
                                                       const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::screen_quad);
}

}  // namespace triptych::opencl_backend
