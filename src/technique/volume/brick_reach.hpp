#pragma once
// Computes how far a ray may leap from a brick without reading the brick map (brick_map.hpp) in
// between.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

// Returns a signed distance, in bricks, for each brick (x fastest). For a visible brick, it is the
// distance to the nearest invisible brick, as a positive number. For an invisible brick, it is the
// distance to the nearest visible brick, as a negative number. Distances are Chebyshev distances,
// that is, the maximum of the distances along the three axes. If all bricks are visible or all are
// invisible, the distance is the length of the grid's longest edge. `visible` is the result of
// technique::brick_visibility.
[[nodiscard]] std::vector<std::int32_t> brick_reach(const std::array<int, 3>& counts,
                                                    std::span<const std::uint32_t> visible);

}  // namespace triptych::technique
