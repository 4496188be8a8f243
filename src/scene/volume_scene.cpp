#include "scene/volume_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace triptych::scene {

std::string_view name_of(Quadrature quadrature) {
  switch (quadrature) {
    case Quadrature::midpoint:
      return "midpoint";
    case Quadrature::preintegrated:
      return "preintegrated";
    case Quadrature::cells:
      return "cells";
  }
  return {};
}

Quadrature quadrature(std::string_view name) {
  for (const Quadrature each :
       {Quadrature::midpoint, Quadrature::preintegrated, Quadrature::cells}) {
    if (name == name_of(each)) return each;
  }
  throw core::InputError(
      fmt::format("quadrature '{}': expected midpoint, preintegrated or cells", name));
}

Box bounding_box(const VoxelGrid& grid) {
  return {.lo = {0, 0, 0},
          .hi = {grid.size[0] * grid.spacing[0], grid.size[1] * grid.spacing[1],
                 grid.size[2] * grid.spacing[2]}};
}

Box VolumeScene::box() const {
  return bounding_box(*grid);
}

double VolumeScene::smallest_spacing() const {
  return *std::min_element(grid->spacing.begin(), grid->spacing.end());
}

int VolumeScene::parts_of_cell() const {
  return static_cast<int>(std::max(std::ceil(1 / step_voxels), 1.0));
}

}  // namespace triptych::scene
