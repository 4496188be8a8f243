#include "backends/vulkan/standalone.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "backends/vulkan/volume_resources.hpp"
#include "core/output_files.hpp"
#include "measure/contract/dump.hpp"
#include "measure/contract/standalone.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_parameters.hpp"
#include "triptych_backend_vulkan_embedded.hpp"

namespace triptych::vulkan_backend {
namespace {

struct Input {
  std::string_view name;
  Binding binding;
  std::string_view kind;    // name of this kind of input in the template
  std::string_view format;  // name of the format in the C API
  std::array<int, 3> extent{0, 0, 0};
  std::span<const std::byte> bytes;
};

std::string_view c_format(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return "VK_FORMAT_R8_UNORM";
    case scene::VoxelFormat::u16:
      return "VK_FORMAT_R16_UNORM";
    case scene::VoxelFormat::f16:
      return "VK_FORMAT_R16_SFLOAT";
    case scene::VoxelFormat::f32:
      break;
  }
  return "VK_FORMAT_R32_SFLOAT";
}

std::vector<std::byte> packed_cells(const scene::VoxelGrid& grid) {
  std::vector<std::byte> cells(technique::packed_bytes(grid.size, grid.format));
  technique::fill_packed_cells(grid, 0, cells);
  return cells;
}

std::string line_of(const Input& input) {
  return fmt::format("    {{{}, {}, {}, {{{}, {}, {}}}, {}, {}}},\n",
                     static_cast<std::uint32_t>(input.binding), input.kind, input.format,
                     input.extent[0], input.extent[1], input.extent[2], input.name,
                     input.bytes.size());
}

}  // namespace

void dump_standalone(const measure::VolumeWork& work, std::string_view code,
                     const Constants& constants, std::uint32_t groups_x, std::uint32_t groups_y) {
  const auto folder = measure::dump_folder();
  if (!folder) return;
  const scene::VolumeScene& scene = work.scene;
  const scene::VoxelGrid& grid = *scene.grid;
  const bool packed = is_packed(work);
  const std::vector<std::byte> parameters = technique::raycast_parameters(
      scene, work.options, packed ? 1 : scene::largest_stored(grid.format));
  const std::vector<std::int32_t> map =
      technique::brick_map(scene, work.options.skip, work.options.adapt);
  const technique::QuadratureTable quadrature = technique::quadrature_table(scene);
  const std::vector<std::byte> cells = packed ? packed_cells(grid) : std::vector<std::byte>{};
  const std::span<const std::byte> entries =
      std::as_bytes(std::span(scene.transfer_function.entries));
  const std::string_view none = "VK_FORMAT_UNDEFINED";
  const std::string_view floats = "VK_FORMAT_R32G32B32A32_SFLOAT";
  const std::string_view buffer = packed ? "texel_buffer" : "storage_buffer";
  const std::string_view cell_format = technique::packed_texel_bytes(grid.format) == 8
                                           ? "VK_FORMAT_R32G32_UINT"
                                           : "VK_FORMAT_R32G32B32A32_UINT";
  const std::array<Input, 5> inputs{
      {{"parameters", parameters_binding, "uniform_buffer", none, {}, parameters},
       {"volume", volume_binding, packed ? "texel_buffer" : "image_3d",
        packed ? cell_format : c_format(grid.format), grid.size,
        packed ? std::span<const std::byte>(cells) : std::as_bytes(std::span(grid.data))},
       {"table",
        transfer_binding,
        packed ? "texel_buffer" : "image_1d",
        floats,
        {static_cast<int>(scene.transfer_function.entries.size()), 1, 1},
        entries},
       {"bricks", bricks_binding, buffer, "VK_FORMAT_R32_SINT", {}, std::as_bytes(std::span(map))},
       {"quadrature",
        quadrature_binding,
        buffer,
        floats,
        {},
        std::as_bytes(std::span(quadrature))}}};
  std::string data = measure::c_words("code", std::as_bytes(std::span(code)));
  data += measure::c_words("constants", std::as_bytes(std::span(&constants, 1)));
  std::string lines;
  for (const Input& each : inputs) {
    data += measure::c_words(each.name, each.bytes);
    lines += line_of(each);
  }
  const bool linear = work.options.sampler == technique::Sampler::hardware;
  core::write_text(
      *folder / "frame.c",
      measure::fill_template(
          embedded("frame_vulkan.c.in"),
          {{"ABOUT",
            fmt::format("Draws an image of {} x {} pixels of a volume with {} x {} x {} voxels.",
                        scene.width, scene.height, grid.size[0], grid.size[1], grid.size[2])},
           {"WIDTH", fmt::to_string(scene.width)},
           {"HEIGHT", fmt::to_string(scene.height)},
           {"GROUPS_X", fmt::to_string(groups_x)},
           {"GROUPS_Y", fmt::to_string(groups_y)},
           {"DATA", data},
           {"JUDGE", std::string(measure::c_judge)},
           {"INPUTS", lines},
           {"FILTER", linear ? "linear" : "nearest"},
           {"SAMPLER", linear ? "VK_FILTER_LINEAR" : "VK_FILTER_NEAREST"},
           {"DOUBLES",
            work.options.precision == technique::Precision::fp64 ? "VK_TRUE" : "VK_FALSE"}}));
}

}  // namespace triptych::vulkan_backend
