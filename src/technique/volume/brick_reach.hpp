#pragma once
// Computes how far a ray may leap from a brick without reading the map in between.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

// Returns, for each brick (x fastest), the distance to the nearest brick of the other kind, in
// bricks. It is positive for a visible brick and negative for an invisible brick. The distance is
// the largest of the distances along the three axes. If there is no brick of the other kind, it is
// the grid's longest edge. `visible` is the result of technique::brick_visibility.
[[nodiscard]] std::vector<std::int32_t> brick_reach(const std::array<int, 3>& counts,
                                                    std::span<const std::uint32_t> visible);

}  // namespace triptych::technique
