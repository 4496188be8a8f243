#pragma once
#include <nlohmann/json_fwd.hpp>

#include "scene/volume_scene.hpp"

namespace triptych::volume_suite {

// Describes the scene under the keys "viewport", "camera" and "volume" of frame.json, which contain
// everything that another program needs to draw the same frame. The key "adapt" is present only if
// `adapt` is not 0.
[[nodiscard]] nlohmann::json describe_frame(const scene::VolumeScene& scene, double ert,
                                            double adapt);

}  // namespace triptych::volume_suite
