#pragma once
#include "backends/vulkan/memory.hpp"

namespace triptych::vulkan_backend {

// Depth and particle of the large spheres that `tiles` has drawn in earlier rounds of a frame.
class TileTarget {
 public:
  TileTarget(const Gpu& gpu, std::uint32_t width, std::uint32_t height);

  // Pipelines made for one of the two passes go with the other as well.
  [[nodiscard]] const vk::raii::RenderPass& pass() const noexcept { return clearing_; }
  [[nodiscard]] static std::vector<vk::Format> formats();
  // A continued pass keeps what is there. Leaves both to be read by shaders.
  void begin(const vk::raii::CommandBuffer& commands, bool continued) const;
  void bind(const Gpu& gpu, vk::DescriptorSet set) const;

 private:
  Image particles_;
  Image depth_;
  vk::raii::Sampler sampler_;
  vk::raii::RenderPass clearing_;
  vk::raii::RenderPass continuing_;
  vk::raii::Framebuffer framebuffer_;
};

}  // namespace triptych::vulkan_backend
