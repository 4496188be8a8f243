// Performs only the fetches and table look-ups of raycast. Runs the same kernel as raycast,
// specialised to sum the values that it reads.
#include "backends/vulkan/compute_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_speed_of_light(const Gpu& gpu, const Instance& instance,
                                                          const measure::VolumeWork& work) {
  Constants constants = constants_of(work);
  constants.speed_of_light = 1;
  return std::make_unique<ComputeFrames>(gpu, instance, work, constants);
}

}  // namespace triptych::vulkan_backend
