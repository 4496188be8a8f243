// Spheres binned into tiles and resolved per pixel, without sprites.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_tiles(const Session& session, Programs& programs,
                                                 const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::rectangle);
}

}  // namespace triptych::opencl_backend
