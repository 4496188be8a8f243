#pragma once
// How far a ray may leap from a brick without looking at the next.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

// Per brick, x fastest: its distance from the nearest brick of the other kind, positive for a
// visible brick, negative for an invisible one; the distance is the greatest of those along the
// three axes. Where there is no brick of the other kind: the grid's longest edge, which reaches
// across. `visible` as of technique::brick_visibility.
[[nodiscard]] std::vector<std::int32_t> brick_reach(const std::array<int, 3>& counts,
                                                    std::span<const std::uint32_t> visible);

}  // namespace triptych::technique
