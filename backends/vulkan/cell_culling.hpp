#pragma once
#include <optional>
#include <string>
#include <vector>

#include "backends/vulkan/particle_data.hpp"

namespace triptych::vulkan_backend {

inline constexpr std::uint32_t commands_binding = first_free_binding;

// The criterion by which a culling pass selects cells, which are ranges of neighbouring particles.
// `view` selects the cells inside the view. The other two criteria are used by the two passes of
// occlusion culling, and also depend on the visibility in the previous frame and on the result of
// the first pass (technique/particles/cull.glsl: TRI_OCCLUSION).
enum class CullPass : std::uint8_t { view, visible_before, newly_visible };

// The passes that cull cells, and the draws of the remaining cells.
class CellCulling {
 public:
  // If `instanced` is true, each particle of a cell is drawn as an instance with four vertices;
  // otherwise as a single vertex. `layout` contains particle_bindings() and commands_binding.
  CellCulling(const Gpu& gpu, const Layout& layout, std::uint32_t cells, bool instanced,
              technique::Culling culling, const Specialization& constants);

  void bind(vk::DescriptorSet set) const;

  // The descriptor set must be bound for compute.
  void record(const vk::raii::CommandBuffer& commands, CullPass pass, bool counting) const;
  void poison() const;
  // Draws every stride-th of the remaining cells, in order.
  void draw(const vk::raii::CommandBuffer& commands, std::uint32_t stride) const;

 private:
  const Gpu& gpu_;
  std::uint32_t cells_;
  Buffer draws_;
  struct Build {
    CullPass pass;
    bool counting;
    vk::Pipeline pipeline;
  };
  std::vector<Build> builds_;
};

// Returns the reason why the device cannot draw the commands of CellCulling; nullopt if it can.
[[nodiscard]] std::optional<std::string> culling_unsupported(const Gpu& gpu, bool instanced);

}  // namespace triptych::vulkan_backend
