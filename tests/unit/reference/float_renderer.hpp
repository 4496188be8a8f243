#pragma once
// Sums samples in single precision, as a device would, to test the error bound.

#include "core/image.hpp"
#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

struct FloatOptions {
  double ert = 0;
  double shift_voxels = 0;  // an injected fault: the field is read with this offset along x
  int weight_bits = 0;      // interpolation weights are rounded to this many bits; 0: not rounded
};

[[nodiscard]] core::Image render_float(const scene::VolumeScene& scene,
                                       const FloatOptions& options);

struct FloatCounts {
  double hits = 0;     // number of rays that hit the volume
  double samples = 0;  // the number of these that have opacity:
  double nonzero = 0;
};
// Counts for all rays, none of which ends early.
[[nodiscard]] FloatCounts count_float(const scene::VolumeScene& scene, const FloatOptions& options);

// The errors that the arithmetic of render_float may make.
[[nodiscard]] ErrorModel float_model(const scene::VolumeScene& scene, const FloatOptions& options);

}  // namespace triptych::reference
