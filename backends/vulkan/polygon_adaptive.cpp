// Draws ray-aligned polygons with 4 to 16 corners, depending on the projected radius. A
// tessellation shader generates them.
#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_polygon_adaptive(const Gpu& gpu,
                                                            const Instance& instance,
                                                            const measure::ParticleWork& work) {
  using enum vk::QueryPipelineStatisticFlagBits;
  return prepare_sprites(
      gpu, instance, work,
      {.draw = {.stages = {attribute_stage,
                           {vk::ShaderStageFlagBits::eTessellationControl,
                            "polygon_adaptive.tesc.spv", "polygon_adaptive_counting.tesc.spv"},
                           {vk::ShaderStageFlagBits::eTessellationEvaluation, "polygon.tese.spv",
                            "polygon.tese.spv"}},
                .topology = vk::PrimitiveTopology::ePatchList},
       .statistics = eTessellationControlShaderPatches | eTessellationEvaluationShaderInvocations});
}

}  // namespace triptych::vulkan_backend
