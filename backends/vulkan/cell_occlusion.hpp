#pragma once
#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

// The state that occlusion culling keeps from frame to frame, and the farthest depth of each block
// of pixels. The camera of a prepared scene does not move. Therefore, from the second frame on, the
// first pass draws everything that is visible and the second pass draws nothing, so particles are
// drawn in the order of technique::Arrangement.
class CellOcclusion {
 public:
  // `layout` contains the bindings of occlusion_bindings().
  CellOcclusion(const Gpu& gpu, const Layout& layout, std::uint32_t cells, vk::Extent3D extent,
                const Specialization& constants);

  void bind(vk::DescriptorSet set) const;
  // Must be recorded before the first pass of a frame. The cells (ranges of neighbouring particles)
  // that were visible in the previous frame become the "before" set of occlusion.glsl.
  void start_frame(const vk::raii::CommandBuffer& commands) const;
  // `depth` must be in the layout eTransferSrcOptimal. The descriptor set must be bound for
  // compute.
  void find_farthest(const vk::raii::CommandBuffer& commands, const Image& depth) const;

 private:
  const Gpu& gpu_;
  vk::Extent3D extent_;
  Buffer visible_before_;
  Buffer visible_now_;
  Buffer farthest_;
  Buffer depths_;
  vk::Pipeline pipeline_;
};

[[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> occlusion_bindings();

}  // namespace triptych::vulkan_backend
