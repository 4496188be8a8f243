// Draws ray-aligned quads, one instance per particle. The vertex shader computes the corners from
// storage buffers.
#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_quad_instanced(const Gpu& gpu, const Instance& instance,
                                                          const measure::ParticleWork& work) {
  return prepare_sprites(
      gpu, instance, work,
      {.draw = {.stages = {{vk::ShaderStageFlagBits::eVertex, "quad_instanced.vert.spv",
                            "quad_instanced_counting.vert.spv"}},
                .instanced = true,
                .topology = vk::PrimitiveTopology::eTriangleStrip},
       .statistics = {}});
}

}  // namespace triptych::vulkan_backend
