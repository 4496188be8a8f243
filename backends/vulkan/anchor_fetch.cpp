// Trilinear fetches by the sampler from a small volume of floats.
#include "backends/vulkan/anchor_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_anchor_fetch(const Gpu& gpu, const Instance& instance,
                                                        const measure::AnchorWork& work) {
  return std::make_unique<AnchorFrames>(gpu, instance, "anchor_fetch", work);
}

}  // namespace triptych::vulkan_backend
