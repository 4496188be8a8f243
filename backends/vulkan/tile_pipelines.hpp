#pragma once
#include <array>
#include <string>
#include <string_view>

#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

// The compute passes of technique/particles/tiles.glsl.
enum class TilePass : std::uint8_t { cells, bin, place, fill, resolve, settle, index };

// The constants of shaders/particle_prelude.glsl, followed by those of shaders/tiles_prelude.glsl.
struct TileConstants {
  ParticleConstants common;
  std::int32_t culling = 0;
  std::int32_t spheres = 0;  // technique::TileRounds::spheres()
};

class TilePipelines {
 public:
  TilePipelines(const Gpu& gpu, const Layout& layout, const Specialization& constants,
                bool counting);

  [[nodiscard]] vk::Pipeline operator[](TilePass pass) const {
    return pipelines_.at(static_cast<std::size_t>(pass));
  }

 private:
  std::vector<vk::Pipeline> pipelines_;
};

// Returns the pipeline that colours the image. `state` describes everything except the stages.
[[nodiscard]] vk::Pipeline tiles_show(const Gpu& gpu, const Layout& layout,
                                      const vk::raii::RenderPass& pass, DrawState state,
                                      const Specialization& constants);

// Returns the hash of the shaders of the timed build, which counts nothing.
[[nodiscard]] std::string tiles_hash(const Specialization& constants);

}  // namespace triptych::vulkan_backend
