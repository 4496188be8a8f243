// Quads that are perpendicular to the ray through the centre; made by a geometry shader.
#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"

namespace triptych::vulkan_backend {

std::unique_ptr<measure::Prepared> prepare_quad_ray(const Gpu& gpu, const Instance& instance,
                                                    const measure::ParticleWork& work) {
  using enum vk::QueryPipelineStatisticFlagBits;
  return prepare_sprites(gpu, instance, work,
                         {.draw = {.stages = {attribute_stage,
                                              {vk::ShaderStageFlagBits::eGeometry,
                                               "quad_ray.geom.spv", "quad_ray_counting.geom.spv"}}},
                          .statistics = eGeometryShaderInvocations | eGeometryShaderPrimitives});
}

}  // namespace triptych::vulkan_backend
