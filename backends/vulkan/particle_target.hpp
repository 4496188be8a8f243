#pragma once
#include <span>
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

// How many different particles the picture shows.
[[nodiscard]] std::uint64_t visible_ids(const core::Image& image);

// A pass over attachments of these formats, the last of them the depth, which it leaves in that
// layout. A continued one keeps what is there; the other clears.
[[nodiscard]] vk::raii::RenderPass depth_pass(const Gpu& gpu,
                                              const std::vector<vk::Format>& formats,
                                              bool continued, vk::ImageLayout layout);
[[nodiscard]] vk::raii::Framebuffer depth_framebuffer(const Gpu& gpu,
                                                      const vk::raii::RenderPass& pass,
                                                      std::span<const vk::ImageView> views,
                                                      vk::Extent3D extent);
// On everything, the scissor too.
void begin_pass(const vk::raii::CommandBuffer& commands, const vk::raii::RenderPass& pass,
                const vk::raii::Framebuffer& framebuffer, vk::Extent3D extent,
                std::span<const vk::ClearValue> clear);

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

  [[nodiscard]] core::Image read(const Gpu& gpu) const;

  static constexpr std::uint32_t colour_targets = 2;
  // Of the passes' attachments.
  [[nodiscard]] static std::vector<vk::Format> formats();

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
