#include "backends/vulkan/cell_culling.hpp"

#include <algorithm>

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t group = 64;  // cull.comp.glsl

}  // namespace

std::optional<std::string> cannot_cull(const Gpu& gpu, bool instanced) {
  if (instanced && gpu.features.drawIndirectFirstInstance == VK_FALSE) {
    return "the device lacks drawIndirectFirstInstance, which culling of instances needs";
  }
  return std::nullopt;
}

CellCulling::CellCulling(const Gpu& gpu, const Layout& layout, std::uint32_t cells, bool instanced,
                         const Specialization& constants)
    : gpu_(gpu),
      cells_(cells),
      draws_(gpu, std::max(cells, 1U) * sizeof(vk::DrawIndirectCommand),
             vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eIndirectBuffer,
             Place::device),
      pipeline_(make_compute_pipeline(
          gpu, layout, spirv(instanced ? "cull_instanced.comp.spv" : "cull.comp.spv"), constants)),
      counting_pipeline_(make_compute_pipeline(
          gpu, layout,
          spirv(instanced ? "cull_instanced_counting.comp.spv" : "cull_counting.comp.spv"),
          constants)) {}

void CellCulling::bind(vk::DescriptorSet set) const {
  bind_buffer(gpu_, set, commands_binding, vk::DescriptorType::eStorageBuffer, draws_);
}

void CellCulling::record(const vk::raii::CommandBuffer& commands, bool counting) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute,
                        counting ? *counting_pipeline_ : *pipeline_);
  commands.dispatch((cells_ + group - 1) / group, 1, 1);
  barrier(commands);
}

void CellCulling::draw(const vk::raii::CommandBuffer& commands, std::uint32_t stride) const {
  constexpr std::uint32_t size = sizeof(vk::DrawIndirectCommand);
  const std::uint32_t most =
      gpu_.features.multiDrawIndirect == VK_TRUE ? gpu_.properties.limits.maxDrawIndirectCount : 1;
  const std::uint32_t draws = (cells_ + stride - 1) / stride;
  for (std::uint32_t begin = 0; begin < draws; begin += std::min(most, draws - begin)) {
    commands.drawIndirect(draws_.get(), vk::DeviceSize{begin} * stride * size,
                          std::min(most, draws - begin), stride * size);
  }
}

}  // namespace triptych::vulkan_backend
