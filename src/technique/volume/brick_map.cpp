#include "technique/volume/brick_map.hpp"

#include "technique/volume/brick_kinds.hpp"
#include "technique/volume/brick_reach.hpp"

namespace triptych::technique {

std::vector<std::int32_t> brick_map(const scene::VolumeScene& scene, Skip skip, double adapt) {
  if (skip == Skip::none) return {1};
  return brick_map(brick_ranges(*scene.grid, brick_layout(scene, skip, adapt)), scene, skip, adapt);
}

std::vector<std::int32_t> brick_map(const BrickRanges& ranges, const scene::VolumeScene& scene,
                                    Skip skip, double adapt) {
  if (skip == Skip::none) return {1};
  if (adapt > 0) return brick_kinds(ranges, scene, adapt);
  const auto visible = brick_visibility(ranges, scene.transfer_function);
  if (skip == Skip::distance) return brick_reach(ranges.counts, visible);
  return {visible.begin(), visible.end()};
}

}  // namespace triptych::technique
