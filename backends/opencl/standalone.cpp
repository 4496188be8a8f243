#include "backends/opencl/standalone.hpp"

#include <fmt/format.h>

#include <vector>

#include "backends/opencl/volume_data.hpp"
#include "core/output_files.hpp"
#include "measure/contract/dump.hpp"
#include "measure/contract/standalone.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_parameters.hpp"
#include "triptych_backend_opencl_embedded.hpp"

namespace triptych::opencl_backend {
namespace {

std::string_view c_order(const cl::ImageFormat& format) {
  switch (format.image_channel_order) {
    case CL_INTENSITY:
      return "CL_INTENSITY";
    case CL_LUMINANCE:
      return "CL_LUMINANCE";
    case CL_RGBA:
      return "CL_RGBA";
    default:
      return "CL_R";
  }
}

std::string_view c_type(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return "CL_UNORM_INT8";
    case scene::VoxelFormat::u16:
      return "CL_UNORM_INT16";
    case scene::VoxelFormat::f16:
      return "CL_HALF_FLOAT";
    case scene::VoxelFormat::f32:
      break;
  }
  return "CL_FLOAT";
}

}  // namespace

void dump_standalone(const Session& session, const measure::VolumeWork& work,
                     const std::string& source, const Constants& constants,
                     std::span<const std::int32_t> map) {
  const auto folder = measure::dump_folder();
  if (!folder) return;
  const scene::VolumeScene& scene = work.scene;
  const scene::VoxelGrid& grid = *scene.grid;
  const bool image = constants.sampler != technique::Sampler::manual;
  const auto format = image ? image_format(session, grid.format) : std::nullopt;
  const technique::QuadratureTable quadrature = technique::quadrature_table(scene);
  std::string data = measure::c_text("source", source);
  data += measure::c_words(
      "parameters", technique::raycast_parameters(
                        scene, work.options, stored_maximum(constants.voxel, constants.sampler)));
  data += measure::c_words("volume", uploaded_voxels(session, grid, constants.sampler));
  data += measure::c_words("table", std::as_bytes(std::span(scene.transfer_function.entries)));
  data += measure::c_words("bricks", std::as_bytes(map));
  data += measure::c_words("quadrature", std::as_bytes(std::span(quadrature)));
  core::write_text(
      *folder / "frame.c",
      measure::fill_template(
          embedded("frame_opencl.c.in"),
          {{"TECHNIQUE", constants.speed_of_light ? "speed_of_light" : "raycast"},
           {"ABOUT",
            fmt::format("Draws an image of {} x {} pixels of a volume with {} x {} x {} voxels.",
                        scene.width, scene.height, grid.size[0], grid.size[1], grid.size[2])},
           {"WIDTH", fmt::to_string(scene.width)},
           {"HEIGHT", fmt::to_string(scene.height)},
           {"DATA", data},
           {"JUDGE", std::string(measure::c_judge)},
           {"OPTIONS", constants.options()},
           {"COUNTERS", fmt::to_string(technique::raycast_counter_stride)},
           {"IS_IMAGE", image ? "1" : "0"},
           {"IMAGE_ORDER", std::string(format ? c_order(*format) : "CL_R")},
           {"IMAGE_TYPE", std::string(c_type(grid.format))},
           {"EXTENT", fmt::format("{}, {}, {}", grid.size[0], grid.size[1], grid.size[2])}}));
}

}  // namespace triptych::opencl_backend
