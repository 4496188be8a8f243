#pragma once
// The brick map that kernels read.

#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// The contents are, for Skip::bricks, 1 or 0 for each brick, or with `adapt` its brick_kinds; for
// Skip::distance brick_reach; and for Skip::none one word that is not read.
[[nodiscard]] std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip,
                                                  double adapt = 0);
// The same with existing ranges, which are those of brick_layout(scene, skip, adapt).
[[nodiscard]] std::vector<std::int32_t> brick_map(const BrickRanges& ranges,
                                                  const scene::VolumeScene& scene, Skip skip,
                                                  double adapt);

}  // namespace triptych::technique
