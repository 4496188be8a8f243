#include "backends/gl/standalone.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <vector>

#include "backends/gl/volume_data.hpp"
#include "core/output_files.hpp"
#include "measure/contract/dump.hpp"
#include "measure/contract/standalone.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_parameters.hpp"
#include "triptych_backend_gl_embedded.hpp"

namespace triptych::gl_backend {
namespace {

// Returns the names of the internal format and of the texel type in the C API.
std::array<std::string, 2> c_format(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return {"GL_R8", "GL_UNSIGNED_BYTE"};
    case scene::VoxelFormat::u16:
      return {"GL_R16", "GL_UNSIGNED_SHORT"};
    case scene::VoxelFormat::f16:
      return {"GL_R16F", "GL_HALF_FLOAT"};
    case scene::VoxelFormat::f32:
      break;
  }
  return {"GL_R32F", "GL_FLOAT"};
}

std::vector<std::byte> voxels_of(const scene::VoxelGrid& grid, bool packed) {
  if (!packed) return {grid.data.begin(), grid.data.end()};
  std::vector<std::byte> cells(technique::packed_bytes(grid.size, grid.format));
  technique::fill_packed_cells(grid, 0, cells);
  return cells;
}

}  // namespace

void dump_standalone(const measure::VolumeWork& work, const std::string& source, GLuint groups_x,
                     GLuint groups_y) {
  const auto folder = measure::dump_folder();
  if (!folder) return;
  const scene::VolumeScene& scene = work.scene;
  const scene::VoxelGrid& grid = *scene.grid;
  const bool packed = is_packed(work);
  const auto map = technique::brick_map(scene, work.options.skip, work.options.adapt);
  const technique::QuadratureTable quadrature = technique::quadrature_table(scene);
  std::string data = measure::c_text("source", source);
  data += measure::c_words(
      "parameters", technique::raycast_parameters(scene, work.options,
                                                  packed ? 1 : scene::largest_stored(grid.format)));
  data += measure::c_words("volume", voxels_of(grid, packed));
  data += measure::c_words("table", std::as_bytes(std::span(scene.transfer_function.entries)));
  data += measure::c_words("bricks", std::as_bytes(std::span(map)));
  data += measure::c_words("quadrature", std::as_bytes(std::span(quadrature)));
  const std::array<std::string, 2> format = c_format(grid.format);
  const bool two_words = technique::packed_texel_bytes(grid.format) == 8;
  core::write_text(
      *folder / "frame.c",
      measure::fill_template(
          embedded("frame_gl.c.in"),
          {{"TECHNIQUE", "raycast"},
           {"ABOUT",
            fmt::format("Draws an image of {} x {} pixels of a volume with {} x {} x {} voxels.",
                        scene.width, scene.height, grid.size[0], grid.size[1], grid.size[2])},
           {"WIDTH", fmt::to_string(scene.width)},
           {"HEIGHT", fmt::to_string(scene.height)},
           {"GROUPS_X", fmt::to_string(groups_x)},
           {"GROUPS_Y", fmt::to_string(groups_y)},
           {"DATA", data},
           {"JUDGE", std::string(measure::c_judge)},
           {"IS_PACKED", packed ? "1" : "0"},
           {"VOLUME_FORMAT", !packed     ? format[0]
                             : two_words ? "GL_RG32UI"
                                         : "GL_RGBA32UI"},
           {"VOLUME_TYPE", format[1]},
           {"EXTENT", fmt::format("{}, {}, {}", grid.size[0], grid.size[1], grid.size[2])},
           {"FILTER",
            work.options.sampler == technique::Sampler::hardware ? "GL_LINEAR" : "GL_NEAREST"}}));
}

}  // namespace triptych::gl_backend
