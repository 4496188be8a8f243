// Performs only the fetches and table look-ups of raycast. Runs the same kernel as raycast,
// compiled to sum the values that it reads.
#include "backends/opencl/techniques.hpp"
#include "backends/opencl/volume_frames.hpp"

namespace triptych::opencl_backend {

std::unique_ptr<measure::Prepared> prepare_speed_of_light(const Session& session,
                                                          Programs& programs, VolumeCache& volumes,
                                                          const measure::VolumeWork& work) {
  Constants constants = constants_of(session, work);
  constants.speed_of_light = true;
  return std::make_unique<VolumeFrames>(session, programs, volumes, work, constants);
}

}  // namespace triptych::opencl_backend
