#pragma once
#include <array>
#include <optional>
#include <vector>

namespace triptych::scene {

// The median distance to the nearest other position, over all distinct positions that single
// precision can represent (other positions do not become particles). For an even number of
// positions it is the upper of the two middle values. Empty if there are fewer than two distinct
// positions. If there are more than 100 000, the median is taken over at most 100 000 of them,
// which are evenly spread in the order of x. Takes O(n log n) for any arrangement.
[[nodiscard]] std::optional<double> median_nearest_distance(
    std::vector<std::array<double, 3>> places);

}  // namespace triptych::scene
