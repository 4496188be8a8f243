// Chains of multiply-adds in registers.
#include "backends/vulkan/anchor_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_anchor_arithmetic(const Gpu& gpu,
                                                             const Instance& instance,
                                                             const measure::AnchorWork& work) {
  return std::make_unique<AnchorFrames>(gpu, instance, "anchor_arithmetic", work);
}

}  // namespace triptych::vulkan_backend
