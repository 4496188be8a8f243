#include "backends/vulkan/tile_pipelines.hpp"

#include <fmt/format.h>

namespace triptych::vulkan_backend {
namespace {

// The names of the passes, in the order of TilePass.
constexpr std::array<std::string_view, 7> pass_names{"cells",   "bin",    "place", "fill",
                                                     "resolve", "settle", "index"};
constexpr std::string_view show_vertex = "tiles_show.vert.spv";
constexpr std::string_view show_fragment = "tiles_show.frag.spv";

std::string_view code_of(std::string_view pass, bool counting) {
  return spirv(fmt::format("tiles_{}{}.comp.spv", pass, counting ? "_counting" : ""));
}

}  // namespace

TilePipelines::TilePipelines(const Gpu& gpu, const Layout& layout, const Specialization& constants,
                             bool counting) {
  for (const std::string_view pass : pass_names) {
    pipelines_.push_back(compute_pipeline(gpu, layout, code_of(pass, counting), constants));
  }
}

vk::Pipeline tiles_show(const Gpu& gpu, const Layout& layout, const vk::raii::RenderPass& pass,
                        DrawState state, const Specialization& constants) {
  state.stages = {{vk::ShaderStageFlagBits::eVertex, spirv(show_vertex)},
                  {vk::ShaderStageFlagBits::eFragment, spirv(show_fragment)}};
  state.topology = vk::PrimitiveTopology::eTriangleStrip;
  return draw_pipeline(gpu, layout, pass, state, constants);
}

std::string tiles_hash(const Specialization& constants) {
  std::vector<std::string_view> codes{spirv(show_vertex), spirv(show_fragment)};
  for (const std::string_view pass : pass_names) codes.push_back(code_of(pass, false));
  return code_hash(codes, constants);
}

}  // namespace triptych::vulkan_backend
