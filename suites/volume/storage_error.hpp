#pragma once
// By how much voxels as a device holds them may differ from the data's own.

#include <string>

#include "scene/volume.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {

struct StorageError {
  double step = 0;      // as PathPrecision::storage_step
  double rounding = 0;  // as PathPrecision::voxel_rounding
};

// `voxel`: the factor's level. `native`: the format that holds the data's values as they are.
// `fits_halves`: whether halves do (scene::fits_halves).
[[nodiscard]] StorageError storage_error(const std::string& voxel, scene::VoxelFormat native,
                                         bool fits_halves, technique::Precision precision);

}  // namespace triptych::volume_suite
