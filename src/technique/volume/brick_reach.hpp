#pragma once
// The distance over which a ray may leap from a brick without reading the next one.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych::technique {

// For each brick (x fastest), the distance to the nearest brick of the other kind. It is positive
// for a visible brick and negative for an invisible one. The distance is the largest of the
// distances along the three axes. If there is no brick of the other kind, it is the grid's longest
// edge. `visible` comes from technique::brick_visibility.
[[nodiscard]] std::vector<std::int32_t> brick_reach(const std::array<int, 3>& counts,
                                                    std::span<const std::uint32_t> visible);

}  // namespace triptych::technique
