#include "backends/vulkan/cell_culling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t cull_group_size = 64;  // as in cull.comp.glsl

std::vector<CullPass> passes_of(technique::Culling culling) {
  using enum technique::Culling;
  if (culling == none) return {};
  if (culling == frustum) return {CullPass::view};
  return {CullPass::visible_before, CullPass::newly_visible};
}

std::string code_name(CullPass pass, bool instanced, bool counting) {
  const std::string_view shape = instanced ? "_instanced" : "";
  const std::string_view build = counting ? "_counting" : "";
  if (pass == CullPass::view) return fmt::format("cull{}{}.comp.spv", shape, build);
  return fmt::format("occlusion{}_{}{}.comp.spv", shape, static_cast<int>(pass), build);
}

}  // namespace

std::optional<std::string> culling_unsupported(const Gpu& gpu, bool instanced) {
  if (instanced && gpu.features.drawIndirectFirstInstance == VK_FALSE) {
    return "the device lacks drawIndirectFirstInstance, which instance culling requires";
  }
  return std::nullopt;
}

CellCulling::CellCulling(const Gpu& gpu, const Layout& layout, std::uint32_t cells, bool instanced,
                         technique::Culling culling, const Specialization& constants)
    : gpu_(gpu),
      cells_(cells),
      draws_(gpu, std::max(cells, 1U) * sizeof(vk::DrawIndirectCommand),
             vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eIndirectBuffer |
                 vk::BufferUsageFlagBits::eTransferDst,
             Place::device) {
  for (const CullPass pass : passes_of(culling)) {
    for (const bool counting : {false, true}) {
      builds_.push_back(
          {pass, counting,
           compute_pipeline(gpu, layout, spirv(code_name(pass, instanced, counting)), constants)});
    }
  }
}

// Overwrites the commands so that they draw nothing. Arbitrary values could make the device draw
// almost endlessly.
void CellCulling::poison() const {
  if (builds_.empty()) return;
  run_once(gpu_, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(draws_.get(), 0, VK_WHOLE_SIZE, 0);
  });
}

void CellCulling::bind(vk::DescriptorSet set) const {
  bind_buffer(gpu_, set, commands_binding, vk::DescriptorType::eStorageBuffer, draws_);
}

void CellCulling::record(const vk::raii::CommandBuffer& commands, CullPass pass,
                         bool counting) const {
  const Label label(gpu_, commands, "cull cells");
  const auto build = std::ranges::find_if(
      builds_, [&](const Build& each) { return each.pass == pass && each.counting == counting; });
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, build->pipeline);
  commands.dispatch((cells_ + cull_group_size - 1) / cull_group_size, 1, 1);
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
