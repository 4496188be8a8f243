#pragma once
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/memory.hpp"
#include "core/image.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::vulkan_backend {

// Reversed depth: the nearest is the greatest, and the first drawn stays on a tie.
[[nodiscard]] vk::CompareOp depth_compare(technique::ParticleFault fault);

// Depth as it was drawn, near/Z, to distance along the view axis; +inf where there is no particle.
void resolve_depth(core::Image& image, double near);

// What sprites are drawn into: colour, ids and reversed depth.
class ParticleTarget {
 public:
  // `cleared_depth`: 0, the farthest there is, or 1 where the farthest is to be kept.
  ParticleTarget(const Gpu& gpu, const scene::ParticleScene& scene, float cleared_depth);

  [[nodiscard]] vk::Extent3D extent() const noexcept { return colour_.extent(); }
  [[nodiscard]] const Image& depth() const noexcept { return depth_; }
  // Pipelines made for one of the two passes go with the other as well.
  [[nodiscard]] const vk::raii::RenderPass& pass() const noexcept { return clearing_; }

  // Leaves all three ready to be copied from. A continued pass keeps what is there.
  void begin(const vk::raii::CommandBuffer& commands, bool continued) const;

  // Overwrites every attachment: colour with NaN.
  void poison(const Gpu& gpu) const;
  [[nodiscard]] core::Image read(const Gpu& gpu) const;

  static constexpr std::uint32_t colour_targets = 2;
  // Of the passes' attachments.
  [[nodiscard]] static std::vector<vk::Format> formats();
  // Why the device cannot draw to it; of its formats only depth is optional.
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
