#include "backends/vulkan/structure_tracer.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t candidate_texels_binding = 13;  // as in nearest_hit.glsl

}  // namespace

StructureTracer::StructureTracer(const Gpu& gpu, const measure::ParticleWork& work,
                                 const ParticleData& data)
    : gpu_(gpu),
      options_(work.options),
      constants_(particle_constants(gpu, work)),
      width_(static_cast<std::uint32_t>(work.scene.width)),
      height_(static_cast<std::uint32_t>(work.scene.height)),
      structure_(gpu, data.particles(), work.options.structure),
      spheres_(texel_view(gpu, data.spheres(), vk::Format::eR32G32B32A32Sfloat)) {}

std::vector<vk::DescriptorSetLayoutBinding> StructureTracer::bindings() const {
  return {storage_binding(SphereStructure::boxes_binding, vk::ShaderStageFlagBits::eCompute),
          {.binding = candidate_texels_binding,
           .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
           .descriptorCount = 1,
           .stageFlags = stages()},
          {.binding = SphereStructure::structure_binding,
           .descriptorType = vk::DescriptorType::eAccelerationStructureKHR,
           .descriptorCount = 1,
           .stageFlags = stages()}};
}

void StructureTracer::bind(vk::DescriptorSet set) const {
  structure_.bind(set);
  bind_texels(gpu_, set, candidate_texels_binding, spheres_);
}

void StructureTracer::prepare(const Layout& layout, vk::DescriptorSet set) {
  structure_.prepare(layout, constants_);
  prepare_rays(layout);
  run_once(gpu_, [&](const vk::raii::CommandBuffer& commands) {
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline, 0, set, {});
    structure_.record_build(commands, false);
  });
}

void StructureTracer::record(const vk::raii::CommandBuffer& commands, const Layout& layout,
                             bool counting) const {
  using technique::Structure;
  if (options_.structure != Structure::built_once) {
    structure_.record_build(commands, options_.structure == Structure::refitted);
  }
  trace_rays(commands, layout, counting, 1);
  if (options_.extra_work_stride > 0 && !counting) {
    barrier(commands);
    trace_rays(commands, layout, counting, static_cast<std::uint32_t>(options_.extra_work_stride));
  }
}

}  // namespace triptych::vulkan_backend
