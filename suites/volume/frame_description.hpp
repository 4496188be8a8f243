#pragma once
#include <nlohmann/json_fwd.hpp>

#include "scene/volume_scene.hpp"

namespace triptych::volume_suite {

// "viewport", "camera" and "volume" of frame.json: everything from which another program can draw
// the same frame. "adapt" where it is not 0.
[[nodiscard]] nlohmann::json describe_frame(const scene::VolumeScene& scene, double ert,
                                            double adapt);

}  // namespace triptych::volume_suite
