#pragma once
#include <array>
#include <optional>
#include <vector>

namespace triptych::scene {

// Returns the median distance between a position and its nearest neighbour, over all distinct
// positions that single precision can represent (positions that it cannot represent do not become
// particles). For an even number of positions, this is the upper of the two middle values. Returns
// nullopt if there are fewer than two distinct positions. If there are more than 100 000 positions,
// the median is taken over at most 100 000 of them, which are evenly spaced in the list of
// positions sorted by x. The run time is O(n log n) for any arrangement.
[[nodiscard]] std::optional<double> median_nearest_distance(
    std::vector<std::array<double, 3>> places);

}  // namespace triptych::scene
