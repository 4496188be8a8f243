// Front-to-back raycasting, with one ray per work item.
#include "backends/opencl/techniques.hpp"
#include "backends/opencl/volume_frames.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_raycast(const Session& session, Programs& programs,
                                                   VolumeCache& volumes,
                                                   const measure::VolumeWork& work) {
  return std::make_unique<VolumeFrames>(session, programs, volumes, work,
                                        constants_of(session, work));
}

}  // namespace triptych::opencl_backend
