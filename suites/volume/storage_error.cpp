#include "suites/volume/storage_error.hpp"

#include "scene/half.hpp"

namespace triptych::volume_suite {

// Integers that are stored as floats are rounded when they are normalised to 0…1. With fp32, this
// error is smaller than the general error of single-precision arithmetic, so it is counted only
// with fp64. error_model derives the error of half floats.
StorageError storage_error(const std::string& voxel, scene::VoxelFormat native, bool fits_halves,
                           technique::Precision precision) {
  if (voxel == "auto") return {};
  const scene::VoxelFormat format = scene::voxel_format(voxel);
  if (format == scene::VoxelFormat::f16) {
    if (fits_halves) return {};
    return {.step = 0x1.0p-28, .rounding = scene::half_roundoff};
  }
  if (format == scene::VoxelFormat::f32 && native != format &&
      precision == technique::Precision::fp64) {
    return {.step = 0x1.0p-24};
  }
  if (scene::bytes_of(format) >= scene::bytes_of(native)) return {};
  return {.step = 1 / scene::largest_stored(format)};
}

}  // namespace triptych::volume_suite
