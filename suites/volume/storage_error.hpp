#pragma once
// The difference between the data's voxels and the voxels that a device stores.

#include <string>

#include "scene/volume.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::volume_suite {

struct StorageError {
  double step = 0;      // see PathPrecision::storage_step
  double rounding = 0;  // see PathPrecision::voxel_rounding
};

// Returns the storage error. `voxel` is the level of the factor `voxel`. `native` is the format
// that stores the data's values exactly. `fits_halves` is true if half floats also store them
// exactly (scene::fits_halves).
[[nodiscard]] StorageError storage_error(const std::string& voxel, scene::VoxelFormat native,
                                         bool fits_halves, technique::Precision precision);

}  // namespace triptych::volume_suite
