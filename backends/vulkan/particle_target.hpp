#pragma once
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/memory.hpp"
#include "core/image.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::vulkan_backend {

// Depth is reversed: the nearest surface has the greatest value. Of two equal depths, the one drawn
// first is kept.
[[nodiscard]] vk::CompareOp depth_compare(technique::ParticleFault fault);

// Converts depth as it was drawn, near/Z, into the distance along the view axis; +inf if there is
// no particle.
void resolve_depth(core::Image& image, double near);

// The target for drawing sprites: colour, ids and reversed depth.
class ParticleTarget {
 public:
  // `cleared_depth`: 0, which is the farthest depth, or 1 if the pass keeps the farthest depth.
  ParticleTarget(const Gpu& gpu, const scene::ParticleScene& scene, float cleared_depth);

  [[nodiscard]] vk::Extent3D extent() const noexcept { return colour_.extent(); }
  [[nodiscard]] const Image& depth() const noexcept { return depth_; }
  // Pipelines that were made for one of the two passes can be used with the other.
  [[nodiscard]] const vk::raii::RenderPass& pass() const noexcept { return clearing_; }

  // Leaves all three attachments ready to be copied from. A continued pass keeps their contents.
  void begin(const vk::raii::CommandBuffer& commands, bool continued) const;

  // Overwrites every attachment: colour with NaN.
  void poison(const Gpu& gpu) const;
  [[nodiscard]] core::Image read(const Gpu& gpu) const;

  static constexpr std::uint32_t colour_targets = 2;
  // The formats of the attachments of the passes.
  [[nodiscard]] static std::vector<vk::Format> formats();
  // The reason why the device cannot draw to it. Only the depth format is optional in Vulkan.
  [[nodiscard]] static std::optional<std::string> format_reason(const Gpu& gpu);

 private:
  double near_;
  std::array<vk::ClearValue, 3> clear_;
  Image colour_;
  Image ids_;
  Image depth_;
  vk::raii::RenderPass clearing_;
  vk::raii::RenderPass continuing_;
  vk::raii::Framebuffer framebuffer_;
};

}  // namespace triptych::vulkan_backend
