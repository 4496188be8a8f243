#include "technique/volume/raycast_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/error.hpp"
#include "scene/camera.hpp"
#include "technique/catalogue.hpp"
#include "technique/volume/brick_kinds.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/extra_work.hpp"
#include "technique/volume/long_rays.hpp"

namespace triptych::technique {
namespace {

template <class Real>
std::array<Real, 4> pack(double x, double y, double z, double w) {
  return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z), static_cast<Real>(w)};
}

template <class Real>
std::array<Real, 4> pack(const glm::dvec3& v, double w) {
  return pack<Real>(v.x, v.y, v.z, w);
}

// Returns the factors that convert a texel to a normalised value. A texel of a UNORM texture is
// k/stored_maximum, rounded to float, where k is the stored integer. In single precision, the scale
// includes the factor `stored_maximum`. In double precision, the shader recovers k exactly.
template <class Real>
std::array<Real, 4> value_map(const scene::VoxelGrid& grid, double stored_maximum, double plane) {
  if constexpr (sizeof(Real) == sizeof(double)) {
    return {grid.scale, grid.offset, plane, stored_maximum > 1 ? stored_maximum : 0};
  }
  return pack<Real>(grid.scale * stored_maximum, grid.offset, plane, 0);
}

template <class Real>
BasicRaycastParameters<Real> parameters_of(const scene::VolumeScene& scene,
                                           const RaycastOptions& options, double stored_maximum) {
  const scene::VoxelGrid& grid = *scene.grid;
  const glm::dvec3 spacing{grid.spacing[0], grid.spacing[1], grid.spacing[2]};
  const double half = scene::tangent_of_half(scene.camera.fov_y_deg);
  const double aspect = static_cast<double>(scene.width) / scene.height;
  const BrickLayout layout = brick_layout(scene, options.skip);
  const auto bricks = brick_counts(grid.size, layout);
  const double plane = ray_plane(scene);
  // With quadrature=cells, the step affects the image only through the number of parts into which a
  // cell is divided. A step longer than one voxel divides no cell, so it is replaced by a step of
  // one voxel. The images for all such steps are therefore bit-identical.
  const bool cells = scene.quadrature == scene::Quadrature::cells;
  const double step_voxels = cells ? std::min(scene.step_voxels, 1.0) : scene.step_voxels;
  const scene::Shading& light = scene.shading;
  const auto& background = scene.background;
  return {
      .eye = pack<Real>((scene.camera.eye + plane * scene.camera.forward) / spacing,
                        step_voxels * scene.smallest_spacing()),
      .ray_centre = pack<Real>(scene.camera.forward, step_voxels),
      .ray_right = pack<Real>(scene.camera.right() * (half * aspect), options.ert),
      .ray_up = pack<Real>(scene.camera.up * half, light.gradient_floor),
      .inverse_spacing = pack<Real>(1.0 / spacing, scene.smallest_spacing()),
      .value_map = value_map<Real>(grid, stored_maximum, plane),
      .shading = pack<Real>(light.ambient, light.diffuse, light.specular, scene.parts_of_cell()),
      .background = {background[0], background[1], background[2], background[3]},
      .volume_size = {grid.size[0], grid.size[1], grid.size[2],
                      std::countr_zero(static_cast<unsigned>(light.exponent))},
      .brick_grid = {bricks[0], bricks[1], bricks[2], options.skip == Skip::none ? 0 : layout.edge},
      .viewport = {scene.width, scene.height, options.extra_work_stride, again_from(scene.width)},
  };
}

template <class Real>
std::vector<std::byte> bytes_of(const BasicRaycastParameters<Real>& parameters) {
  const auto bytes = std::as_bytes(std::span(&parameters, 1));
  return {bytes.begin(), bytes.end()};
}

// Returns why the scene cannot be drawn with quadrature=cells, or nullopt if it can. An iteration
// of the raycaster's loop processes one piece of a cell; long_rays.hpp explains why the number of
// iterations is limited.
std::optional<std::string> cells_reason(const scene::VolumeScene& scene,
                                        const RaycastOptions& options) {
  if (options.sampler == Sampler::hardware) {
    return "quadrature=cells requires sampler=manual or sampler=packed, because it reads "
           "unfiltered voxels";
  }
  if (cell_passes(scene, 0) <= most_cell_passes) return std::nullopt;
  return fmt::format(
      "quadrature=cells would cut a ray into {} pieces, one per loop iteration, and some drivers "
      "silently end such long loops; use a longer step",
      cell_passes(scene, 0));
}

// Returns an error message if rays have too many samples in this scene, or nullopt. Samples are
// counted in 32-bit integers. Only extremely flat voxels would require more samples, which would
// not improve the image.
std::optional<std::string> count_reason(const scene::VolumeScene& scene) {
  const double samples = most_samples(scene);
  if (samples < 1 << 30) return std::nullopt;
  return fmt::format(
      "a ray would need up to {:.2g} samples, but the limit is 2³⁰; use a longer step", samples);
}

}  // namespace

std::string_view name_of(Sampler sampler) {
  switch (sampler) {
    case Sampler::hardware:
      return "hardware";
    case Sampler::manual:
      return "manual";
    case Sampler::packed:
      return "packed";
  }
  return {};
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
std::string_view name_of(Precision precision) {
  return precision == Precision::fp32 ? "fp32" : "fp64";
}

Sampler sampler(std::string_view name) {
  if (name == "hardware") return Sampler::hardware;
  if (name == "manual") return Sampler::manual;
  if (name == "packed") return Sampler::packed;
  throw core::InputError(
      fmt::format("unknown sampler '{}'; expected hardware, manual or packed", name));
}

Skip skip(std::string_view name) {
  if (name == "none") return Skip::none;
  if (name == "bricks") return Skip::bricks;
  if (name == "distance") return Skip::distance;
  throw core::InputError(fmt::format("unknown skip '{}'; expected none, bricks or distance", name));
}

Precision precision(std::string_view name) {
  if (name == "fp32") return Precision::fp32;
  if (name == "fp64") return Precision::fp64;
  throw core::InputError(fmt::format("unknown precision '{}'; expected fp32 or fp64", name));
}

std::optional<std::string> raycast_reason(std::string_view technique,
                                          const scene::VolumeScene& scene,
                                          const RaycastOptions& options) {
  const bool midpoint = scene.quadrature == scene::Quadrature::midpoint;
  const std::string_view quadrature = scene::name_of(scene.quadrature);
  const bool only_fetches = !technique::technique(technique).draws_image;
  if (only_fetches && !midpoint) {
    return fmt::format(
        "{} requires quadrature=midpoint; with quadrature={}, other techniques fetch and look up "
        "different data, so the time of this technique is not a lower bound for their times",
        technique, quadrature);
  }
  if (scene.quadrature == scene::Quadrature::cells) {
    if (auto reason = cells_reason(scene, options)) return reason;
  } else if (auto reason = count_reason(scene)) {
    return reason;
  }
  if (auto reason = adapt_reason(technique, scene, options)) return reason;
  if (options.precision == Precision::fp32) return std::nullopt;
  if (only_fetches) {
    return fmt::format("{} supports only precision=fp32, because it performs almost no arithmetic",
                       technique);
  }
  if (!midpoint) {
    return fmt::format(
        "quadrature={} is available only in single precision; precision=fp64 requires "
        "quadrature=midpoint",
        quadrature);
  }
  if (options.sampler == Sampler::hardware) {
    return "precision=fp64 requires sampler=manual or sampler=packed, because hardware samplers "
           "interpolate in single precision at best";
  }
  return std::nullopt;
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
  return nearest > far_eye_in_diagonals * glm::length(box.hi - box.lo) ? nearest : 0;
}

std::vector<std::byte> raycast_parameters(const scene::VolumeScene& scene,
                                          const RaycastOptions& options, double stored_maximum) {
  return options.precision == Precision::fp64
             ? bytes_of(parameters_of<double>(scene, options, stored_maximum))
             : bytes_of(parameters_of<float>(scene, options, stored_maximum));
}

}  // namespace triptych::technique
