// Draws squares around the projected centres. Spheres that exceed the largest square are drawn as
// screen-aligned quads.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_point(const Session& session, Programs& programs,
                                                 const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::point);
}

}  // namespace triptych::opencl_backend
