// Ray-aligned quads; made by a tessellation shader.
#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_quad_tess(const Gpu& gpu, const Instance& instance,
                                                     const measure::ParticleWork& work) {
  using enum vk::QueryPipelineStatisticFlagBits;
  return prepare_sprites(
      gpu, instance, work,
      {.draw = {.stages = {attribute_stage,
                           {vk::ShaderStageFlagBits::eTessellationControl, "quad_tess.tesc.spv",
                            "quad_tess_counting.tesc.spv"},
                           {vk::ShaderStageFlagBits::eTessellationEvaluation, "quad_tess.tese.spv",
                            "quad_tess.tese.spv"}},
                .topology = vk::PrimitiveTopology::ePatchList},
       .statistics = eTessellationControlShaderPatches | eTessellationEvaluationShaderInvocations});
}

}  // namespace triptych::vulkan_backend
