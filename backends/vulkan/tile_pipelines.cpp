#include "backends/vulkan/tile_pipelines.hpp"

#include <fmt/format.h>

namespace triptych::vulkan_backend {
namespace {

// In the order of TilePass.
constexpr std::array<std::string_view, 8> passes{"cells",   "bin",      "place", "fill",
                                                 "resolve", "farthest", "index", "shade"};

std::string_view code_of(std::string_view pass, bool counting) {
  return spirv(fmt::format("tiles_{}{}.comp.spv", pass, counting ? "_counting" : ""));
}

}  // namespace

TilePipelines::TilePipelines(const Gpu& gpu, const Layout& layout, const Specialization& constants,
                             bool counting) {
  for (const std::string_view pass : passes) {
    pipelines_.push_back(compute_pipeline(gpu, layout, code_of(pass, counting), constants));
  }
}

std::string tiles_hash(const Specialization& constants) {
  std::array<std::string_view, passes.size()> codes;
  for (std::size_t i = 0; i < passes.size(); ++i) codes.at(i) = code_of(passes.at(i), false);
  return code_hash(codes, constants);
}

}  // namespace triptych::vulkan_backend
