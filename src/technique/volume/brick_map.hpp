#pragma once
// What kernels are told of a volume's bricks.

#include <cstdint>
#include <vector>

#include "scene/volume_scene.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::technique {

// 1 or 0 per brick for Skip::bricks, or with `adapt` brick_kinds; brick_reach for Skip::distance;
// one word that nothing reads for Skip::none.
[[nodiscard]] std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip,
                                                  double adapt = 0);
// The same with the scene's ranges at hand, of brick_layout(scene, skip, adapt).
[[nodiscard]] std::vector<std::int32_t> brick_map(const BrickRanges& ranges,
                                                  const scene::VolumeScene& scene, Skip skip,
                                                  double adapt);

}  // namespace triptych::technique
