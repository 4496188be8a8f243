#pragma once
#include <array>
#include <optional>
#include <vector>

namespace triptych::scene {

// The median over all distinct places that single precision can hold, as the others become no
// particles, of the distance to the nearest other one (the upper of the middle two). Nothing where
// fewer than two are distinct. Of more than 100 000 places as many are asked, evenly spread over
// them in the order of x. O(n log n) for any arrangement.
[[nodiscard]] std::optional<double> median_nearest_distance(
    std::vector<std::array<double, 3>> places);

}  // namespace triptych::scene
