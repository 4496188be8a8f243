#pragma once
// A renderer that accumulates samples in single precision, as a device would, for tests of the
// error bound.

#include "core/image.hpp"
#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

struct FloatOptions {
  double ert = 0;
  // Injects a fault: the field is read with this offset along x.
  double shift_voxels = 0;
  // The number of bits to which interpolation weights are rounded, or 0 not to round them.
  int weight_bits = 0;
};

[[nodiscard]] core::Image render_float(const scene::VolumeScene& scene,
                                       const FloatOptions& options);

struct FloatCounts {
  double hits = 0;  // number of rays that hit the volume
  // Number of samples, and number of samples with non-zero opacity.
  double samples = 0;
  double nonzero = 0;
};
// Counts hits and samples over all rays, without early ray termination.
[[nodiscard]] FloatCounts count_float(const scene::VolumeScene& scene, const FloatOptions& options);

// Returns the error model of the arithmetic of render_float().
[[nodiscard]] ErrorModel float_model(const scene::VolumeScene& scene, const FloatOptions& options);

}  // namespace triptych::reference
