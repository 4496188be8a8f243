#include "suites/volume/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych::volume_suite {
namespace {

constexpr double unit_roundoff = 0x1.0p-24;

double largest_stored(scene::VoxelFormat format) {
  switch (format) {
    case scene::VoxelFormat::u8:
      return 255;
    case scene::VoxelFormat::u16:
      return 65535;
    case scene::VoxelFormat::f32:
      return 1;
  }
  return 1;
}

double position_error(const scene::VolumeScene& scene) {
  const scene::VoxelGrid& grid = *scene.grid;
  const glm::dvec3 spacing{grid.spacing[0], grid.spacing[1], grid.spacing[2]};
  const glm::dvec3 size{grid.size[0], grid.size[1], grid.size[2]};
  const glm::dvec3 eye = scene.camera.eye / spacing;
  const double diagonal = glm::length(size);
  const double farthest = glm::length(glm::max(glm::abs(eye), glm::abs(eye - size)));
  const double outside = std::max(farthest - diagonal, 0.0);
  return unit_roundoff * (glm::length(eye) + 48 * outside + 25 * diagonal);
}

}  // namespace

reference::ErrorModel error_model(const scene::VolumeScene& scene, const PathPrecision& path) {
  const scene::VoxelGrid& grid = *scene.grid;
  const double format_range = std::abs(grid.scale) * largest_stored(grid.format);
  const double magnitude = format_range + std::abs(grid.offset);
  const double filter =
      std::exp2(std::ceil(std::log2(std::max(path.filter_weight_error, unit_roundoff))));
  return {
      .position_error_voxels = position_error(scene),
      .value_error = 13 * unit_roundoff * std::max(magnitude, 1.0) + path.storage_step / 2 +
                     filter * format_range,
      .filter_weight_error = filter,
      .table_error = 3 * unit_roundoff,
      .opacity_error = 14 * unit_roundoff,
      .compositing_error = 4 * unit_roundoff,
      .ert = path.ert,
  };
}

}  // namespace triptych::volume_suite
