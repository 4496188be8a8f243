#include "technique/volume/raycast_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/extra_work.hpp"

namespace triptych::technique {
namespace {

std::array<float, 4> pack(const glm::dvec3& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
          static_cast<float>(w)};
}

}  // namespace

std::string_view name_of(Sampler sampler) {
  return sampler == Sampler::hardware ? "hardware" : "manual";
}
std::string_view name_of(Skip skip) {
  switch (skip) {
    case Skip::none:
      return "none";
    case Skip::bricks:
      return "bricks";
    case Skip::distance:
      return "distance";
  }
  return {};
}

Sampler sampler(std::string_view name) {
  if (name == "hardware") return Sampler::hardware;
  if (name == "manual") return Sampler::manual;
  throw core::InputError(fmt::format("sampler '{}': expected hardware or manual", name));
}

Skip skip(std::string_view name) {
  if (name == "none") return Skip::none;
  if (name == "bricks") return Skip::bricks;
  if (name == "distance") return Skip::distance;
  throw core::InputError(fmt::format("skip '{}': expected none, bricks or distance", name));
}

std::optional<std::string> quadrature_reason(std::string_view technique,
                                             scene::Quadrature quadrature) {
  if (technique != "speed_of_light" || quadrature == scene::Quadrature::midpoint) {
    return std::nullopt;
  }
  return "speed_of_light bounds the midpoint rule: its fetches and look-ups are not those of "
         "quadrature preintegrated";
}

double ray_plane(const scene::VolumeScene& scene) {
  const scene::Box box = scene.box();
  double nearest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) == 0 ? box.lo.x : box.hi.x,
                        (corner & 2) == 0 ? box.lo.y : box.hi.y,
                        (corner & 4) == 0 ? box.lo.z : box.hi.z);
    nearest = std::min(nearest, glm::dot(at - scene.camera.eye, scene.camera.forward));
  }
  return nearest > far_in_diagonals * glm::length(box.hi - box.lo) ? nearest : 0;
}

RaycastParameters raycast_parameters(const scene::VolumeScene& scene, const RaycastOptions& options,
                                     double stored_maximum) {
  const scene::VoxelGrid& grid = *scene.grid;
  const glm::dvec3 spacing{grid.spacing[0], grid.spacing[1], grid.spacing[2]};
  const double half = std::tan(scene.camera.fov_y_deg * std::numbers::pi / 360);
  const double aspect = static_cast<double>(scene.width) / scene.height;
  const BrickLayout layout = brick_layout(scene, options.skip);
  const auto bricks = brick_counts(grid.size, layout);
  const double plane = ray_plane(scene);
  const scene::Shading& light = scene.shading;
  return {
      .eye = pack((scene.camera.eye + plane * scene.camera.forward) / spacing, scene.step_world()),
      .ray_centre = pack(scene.camera.forward, scene.step_voxels),
      .ray_right = pack(scene.camera.right() * (half * aspect), options.ert),
      .ray_up = pack(scene.camera.up * half, light.gradient_floor),
      .inverse_spacing = pack(1.0 / spacing, scene.smallest_spacing()),
      .value_map = {static_cast<float>(grid.scale * stored_maximum),
                    static_cast<float>(grid.offset), static_cast<float>(plane), 0},
      .shading = {static_cast<float>(light.ambient), static_cast<float>(light.diffuse),
                  static_cast<float>(light.specular), 0},
      .background = scene.background,
      .volume_size = {grid.size[0], grid.size[1], grid.size[2],
                      std::countr_zero(static_cast<unsigned>(light.exponent))},
      .brick_grid = {bricks[0], bricks[1], bricks[2], options.skip == Skip::none ? 0 : layout.edge},
      .viewport = {scene.width, scene.height, options.extra_work_stride, again_from(scene.width)},
  };
}

}  // namespace triptych::technique
