#pragma once
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/memory.hpp"
#include "core/image.hpp"
#include "scene/particle_scene.hpp"
#include "technique/particles/particle_options.hpp"

namespace triptych::vulkan_backend {

// Returns the depth test. Depth is reversed: the nearest surface has the greatest value. If two
// depths are equal, the sphere drawn first wins.
[[nodiscard]] vk::CompareOp depth_compare(technique::ParticleFault fault);

// Converts the drawn depths, which are near/Z, to the distances Z along the view axis, or to
// +infinity for pixels without a particle.
void resolve_depth(core::Image& image, double near);

// The render target for sprites: colour, ids and reversed depth.
class ParticleTarget {
 public:
  // `cleared_depth` is 0, the farthest depth, or 1 if the depth test keeps the farthest depth.
  ParticleTarget(const Gpu& gpu, const scene::ParticleScene& scene, float cleared_depth);

  [[nodiscard]] vk::Extent3D extent() const noexcept { return colour_.extent(); }
  [[nodiscard]] const Image& depth() const noexcept { return depth_; }
  // Returns the render pass that clears the attachments. A pipeline that was created for it can
  // also be used in the render pass that keeps their contents.
  [[nodiscard]] const vk::raii::RenderPass& pass() const noexcept { return clearing_; }

  // Begins a pass, which leaves all three attachments ready to be copied from. A continued pass
  // keeps their contents.
  void begin(const vk::raii::CommandBuffer& commands, bool continued) const;

  // Overwrites every attachment; colour becomes NaN.
  void poison(const Gpu& gpu) const;
  [[nodiscard]] core::Image read(const Gpu& gpu) const;

  static constexpr std::uint32_t colour_targets = 2;
  // Returns the formats of the attachments of the passes.
  [[nodiscard]] static std::vector<vk::Format> formats();
  // Returns the reason why the device cannot draw to the target. Only the depth format is optional
  // in Vulkan.
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
