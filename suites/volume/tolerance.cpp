#include "suites/volume/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/camera.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {
namespace {

constexpr double float_roundoff = 0x1.0p-24;

double unit_roundoff(technique::Precision precision) {
  return precision == technique::Precision::fp64 ? 0x1.0p-52 : float_roundoff;
}

// Returns the largest distance from `origin` at which a ray from the eye can enter the box: the
// distance of the farthest corner of the faces that the eye sees, or 0 if the eye is inside.
double farthest_entry(const scene::Box& box, const glm::dvec3& eye, const glm::dvec3& origin) {
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool below = eye[axis] < box.lo[axis];
    if (!below && eye[axis] <= box.hi[axis]) continue;
    glm::dvec3 reach = glm::max(glm::abs(origin - box.lo), glm::abs(origin - box.hi));
    reach[axis] = std::abs(origin[axis] - (below ? box.lo : box.hi)[axis]);
    farthest = std::max(farthest, glm::length(reach));
  }
  return farthest;
}

// Returns the largest position error in voxels per axis (derived in tolerance.hpp). `u` is the unit
// roundoff. Lengths are divided by the smallest spacing, which yields an upper bound on the number
// of voxels along any axis.
double position_error(const scene::VolumeScene& scene, double u) {
  const scene::VoxelGrid& grid = *scene.grid;
  const glm::dvec3 spacing{grid.spacing[0], grid.spacing[1], grid.spacing[2]};
  const scene::Box box = scene.box();
  const double voxel = scene.smallest_spacing();
  const double plane = technique::ray_plane(scene);
  const glm::dvec3 origin = scene.camera.eye + plane * scene.camera.forward;
  const double diagonal = glm::length(box.hi) / voxel;
  const double farthest =
      glm::length(glm::max(glm::abs(origin), glm::abs(origin - box.hi))) / voxel;
  const double entry = farthest_entry(box, scene.camera.eye, origin) / voxel;
  double error = glm::length(origin / spacing) + 20 * farthest + 7 * entry + 7 * diagonal;
  if (plane > 0) {
    const double half = scene::tangent_of_half(scene.camera.fov_y_deg);
    const double aspect = static_cast<double>(scene.width) / scene.height;
    error += 4 * plane / voxel * half * std::hypot(aspect, 1.0) + 6 * farthest;
  }
  return u * error;
}

// Returns the smallest power of two that is not less than a positive number.
double next_power_of_two(double x) {
  const double below = std::ldexp(1.0, std::ilogb(x));
  return below < x ? 2 * below : below;
}

}  // namespace

reference::ErrorModel error_model(const scene::VolumeScene& scene, const PathPrecision& path) {
  const bool fp64 = path.precision == technique::Precision::fp64;
  const double u = unit_roundoff(path.precision);
  const scene::VoxelGrid& grid = *scene.grid;
  const double format_range = std::abs(grid.scale) * scene::largest_stored(grid.format);
  const double magnitude = format_range + std::abs(grid.offset);
  const bool midpoint = scene.quadrature == scene::Quadrature::midpoint;
  const bool preintegrated = scene.quadrature == scene::Quadrature::preintegrated;
  const bool cells = scene.quadrature == scene::Quadrature::cells;
  const double filter = next_power_of_two(std::max(path.filter_weight_error, u));
  return {
      .position_error_voxels = position_error(scene, u),
      .value_error = 13 * u * std::max(magnitude, 1.0) + (cells ? 84 * u * format_range : 0) +
                     path.storage_step / 2 + filter * format_range,
      .voxel_rounding = path.voxel_rounding,
      .filter_weight_error = filter,
      .table_error = (preintegrated ? 4 : 3) * u,
      .opacity_error = (!midpoint ? 32
                        : fp64    ? 18
                                  : 14) *
                       u,
      .compositing_error = 4 * u,
      .ert = path.ert,
      .adapt = path.adapt,
      .output_error = fp64 ? 2 * float_roundoff : 0,
  };
}

}  // namespace triptych::volume_suite
