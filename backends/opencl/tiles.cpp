// Sorts spheres into tiles. Each pixel finds the nearest sphere in its tile. There are no sprites.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_tiles(const Session& session, Programs& programs,
                                                 const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::rectangle);
}

}  // namespace triptych::opencl_backend
