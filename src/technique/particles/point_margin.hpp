#pragma once
#include <string_view>

namespace triptych::technique {

// Pixels to add to the size of a point so that the device draws no less than the square that was
// meant (TRI_POINT_MARGIN). Sizes are multiples of `granularity` and may be rounded down to one,
// but by the drivers that are known to do otherwise, which `renderer` names in the API's own words.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

}  // namespace triptych::technique
