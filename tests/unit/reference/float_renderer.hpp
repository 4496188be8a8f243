#pragma once
// The sample sum in single precision, as a device would do it: the subject of the error bound's
// tests.

#include "core/image.hpp"
#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

struct FloatOptions {
  double ert = 0;
  double shift_voxels = 0;  // an injected fault: the field is read that far off along x
  int weight_bits = 0;      // interpolation weights rounded to so many bits; 0: not rounded
};

[[nodiscard]] core::Image render_float(const scene::VolumeScene& scene,
                                       const FloatOptions& options);

struct FloatCounts {
  double hits = 0;     // rays
  double samples = 0;  // of which so many have opacity:
  double nonzero = 0;
};
// Of all rays, none of which ends early.
[[nodiscard]] FloatCounts count_float(const scene::VolumeScene& scene, const FloatOptions& options);

// What the arithmetic of render_float may do wrong.
[[nodiscard]] ErrorModel float_model(const scene::VolumeScene& scene, const FloatOptions& options);

}  // namespace triptych::reference
