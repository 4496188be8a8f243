// One invocation per dispatch, many dispatches.
#include "backends/vulkan/anchor_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_anchor_launch(const Gpu& gpu, const Instance& instance,
                                                         const measure::AnchorWork& work) {
  return std::make_unique<AnchorFrames>(gpu, instance, "anchor_launch", work);
}

}  // namespace triptych::vulkan_backend
