// Draws ray-aligned polygons with a given number of corners.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_polygon_tess(const Session& session, Programs& programs,
                                                        const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::polygon);
}

}  // namespace triptych::opencl_backend
