#pragma once
#include "accuracy/ray_history.hpp"
#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::volume_suite {

// Returns the samples that a device should take for pixel (x, y). Throws core::NotSupported for
// quadrature=cells.
[[nodiscard]] accuracy::ExpectedRay pixel_history(const scene::VolumeScene& scene,
                                                  const reference::ErrorModel& model, int x, int y);

}  // namespace triptych::volume_suite
