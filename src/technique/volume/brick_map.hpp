#pragma once
// The brick map, which kernels read to skip empty space.

#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// Creates the map. For Skip::bricks it contains 1 for each visible brick and 0 for each invisible
// one or, if `adapt` is not 0, the result of brick_kinds. For Skip::distance it contains the result
// of brick_reach. For Skip::none it is one word that is never read.
[[nodiscard]] std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip,
                                                  double adapt = 0);
// Creates the same map from ranges that have already been computed for brick_layout(scene, skip,
// adapt).
[[nodiscard]] std::vector<std::int32_t> brick_map(const BrickRanges& ranges,
                                                  const scene::VolumeScene& scene, Skip skip,
                                                  double adapt);

}  // namespace triptych::technique
