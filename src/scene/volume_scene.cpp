#include "scene/volume_scene.hpp"

#include <algorithm>

namespace triptych::scene {

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

}  // namespace triptych::scene
