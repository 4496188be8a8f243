// Draws ray-aligned polygons with 4 to 16 corners, depending on the projected radius.
#include "backends/opencl/particle_frames.hpp"
#include "backends/opencl/techniques.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_polygon_adaptive(const Session& session,
                                                            Programs& programs,
                                                            const measure::ParticleWork& work) {
  return std::make_unique<ParticleFrames>(session, programs, work, Sprite::adaptive_polygon);
}

}  // namespace triptych::opencl_backend
