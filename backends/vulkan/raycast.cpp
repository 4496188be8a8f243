// Front-to-back raycasting in a compute kernel, with one ray per invocation.
#include "backends/vulkan/compute_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_raycast(const Gpu& gpu, const Instance& instance,
                                                   const measure::VolumeWork& work) {
  return std::make_unique<ComputeFrames>(gpu, instance, work, constants_of(work));
}

}  // namespace triptych::vulkan_backend
