#pragma once
// The brick map that kernels read.

#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// Makes the map. For Skip::bricks it contains 1 or 0 for each brick, or with `adapt` its
// brick_kinds. For Skip::distance it contains brick_reach. For Skip::none it is one word that is
// not read.
[[nodiscard]] std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip,
                                                  double adapt = 0);
// The same map, made from existing ranges, which are those of brick_layout(scene, skip, adapt).
[[nodiscard]] std::vector<std::int32_t> brick_map(const BrickRanges& ranges,
                                                  const scene::VolumeScene& scene, Skip skip,
                                                  double adapt);

}  // namespace triptych::technique
