#pragma once
#include <array>
#include <string>
#include <string_view>

#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

// The compute passes of technique/particles/tiles.glsl; farthest without and with large spheres.
enum class TilePass : std::uint8_t { cells, bin, place, fill, farthest, farthest_large, index };

// Constants of shaders/particle_prelude.glsl and, behind them, of shaders/tiles_prelude.glsl.
struct TileConstants {
  ParticleConstants common;
  std::int32_t culling = 0;
};

class TilePipelines {
 public:
  // `carried`: with farthest_large, for layouts that have the images of a TileTarget.
  TilePipelines(const Gpu& gpu, const Layout& layout, const Specialization& constants,
                bool counting, bool carried);

  [[nodiscard]] vk::Pipeline operator[](TilePass pass) const {
    return pipelines_.at(static_cast<std::size_t>(pass));
  }

 private:
  std::vector<vk::Pipeline> pipelines_;
};

// The stages that draw tiles: into a TileTarget, or what a frame shows into a ParticleTarget, with
// the large spheres of earlier rounds or without any.
enum class TileDraw : std::uint8_t { large, show, show_with_large };
[[nodiscard]] vk::Pipeline tile_draw(const Gpu& gpu, const Layout& layout,
                                     const vk::raii::RenderPass& pass, TileDraw draw,
                                     DrawState state, const Specialization& constants);

// Of the timed build.
[[nodiscard]] std::string tiles_hash(const Specialization& constants);

}  // namespace triptych::vulkan_backend
