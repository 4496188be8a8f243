#pragma once
#include <array>
#include <optional>
#include <vector>

namespace triptych::scene {

// The median of the distance to the nearest other position, over all distinct positions that single
// precision can represent (others become no particles). For an even number it is the upper one of
// the two in the middle. Empty if fewer than two positions are distinct. If there are more than 100
// 000 positions, it is the median of that many of them, which are evenly spread in the order of x.
// O(n log n) for any arrangement.
[[nodiscard]] std::optional<double> median_nearest_distance(
    std::vector<std::array<double, 3>> places);

}  // namespace triptych::scene
