#include "backends/vulkan/tile_pipelines.hpp"

#include <fmt/format.h>

namespace triptych::vulkan_backend {
namespace {

// In the order of TilePass.
constexpr std::array<std::string_view, 7> passes{
    "cells", "bin", "place", "fill", "farthest_0", "farthest_1", "index"};
// In the order of TileDraw.
constexpr std::array<std::array<std::string_view, 2>, 3> stages{
    {{"tiles_draw.vert.spv", "tiles_draw.frag.spv"},
     {"tiles_show.vert.spv", "tiles_show_0.frag.spv"},
     {"tiles_show.vert.spv", "tiles_show_1.frag.spv"}}};

std::string_view code_of(std::string_view pass, bool counting) {
  return spirv(fmt::format("tiles_{}{}.comp.spv", pass, counting ? "_counting" : ""));
}

}  // namespace

TilePipelines::TilePipelines(const Gpu& gpu, const Layout& layout, const Specialization& constants,
                             bool counting, bool carried) {
  for (const std::string_view pass : passes) {
    if (pass == "farthest_1" && !carried) {
      pipelines_.emplace_back();
      continue;
    }
    pipelines_.push_back(compute_pipeline(gpu, layout, code_of(pass, counting), constants));
  }
}

vk::Pipeline tile_draw(const Gpu& gpu, const Layout& layout, const vk::raii::RenderPass& pass,
                       TileDraw draw, DrawState state, const Specialization& constants) {
  const auto& [vertex, fragment] = stages.at(static_cast<std::size_t>(draw));
  state.stages = {{vk::ShaderStageFlagBits::eVertex, spirv(vertex)},
                  {vk::ShaderStageFlagBits::eFragment, spirv(fragment)}};
  state.topology = vk::PrimitiveTopology::eTriangleStrip;
  return draw_pipeline(gpu, layout, pass, state, constants);
}

std::string tiles_hash(const Specialization& constants) {
  std::vector<std::string_view> codes;
  for (const std::string_view pass : passes) codes.push_back(code_of(pass, false));
  for (const auto& pair : stages) {
    for (const std::string_view stage : pair) codes.push_back(spirv(stage));
  }
  return code_hash(codes, constants);
}

}  // namespace triptych::vulkan_backend
