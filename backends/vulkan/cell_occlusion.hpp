#pragma once
#include "backends/vulkan/descriptors.hpp"
#include "backends/vulkan/memory.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

// What occlusion culling remembers from frame to frame, and the farthest depth of each block of
// pixels. The camera of a prepared scene stands still: from the second frame on the first pass
// draws all that can be seen and the second nothing, so that the order of drawing is the
// arrangement's.
class CellOcclusion {
 public:
  // `layout` holds the bindings of occlusion_bindings().
  CellOcclusion(const Gpu& gpu, const Layout& layout, std::uint32_t cells, vk::Extent3D extent,
                const Specialization& constants);

  void bind(vk::DescriptorSet set) const;
  // What was seen now becomes what was seen before.
  void start_frame(const vk::raii::CommandBuffer& commands) const;
  // `depth` lies in eTransferSrcOptimal. The set must be bound for compute.
  void find_farthest(const vk::raii::CommandBuffer& commands, const Image& depth) const;

 private:
  const Gpu& gpu_;
  vk::Extent3D extent_;
  Buffer before_;
  Buffer now_;
  Buffer farthest_;
  Buffer depths_;
  vk::Pipeline pipeline_;
};

[[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> occlusion_bindings();

}  // namespace triptych::vulkan_backend
