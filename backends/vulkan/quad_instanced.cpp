// Ray-aligned quads that the vertex shader makes from storage buffers, one instance each.
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
