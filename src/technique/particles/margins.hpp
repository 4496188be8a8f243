#pragma once
#include <string_view>

namespace triptych::technique {

// The number of pixels to add to the size of a point so that the device draws at least the intended
// square (TRI_POINT_MARGIN). Sizes are multiples of `granularity` and may be rounded down to one,
// except on drivers that are known to behave differently. `renderer` is the API's name of the
// driver.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

// The number of pixels by which a sprite must be larger on each side, in addition to its margin of
// 1/64 (TRI_SPRITE_GROWTH), on a device that rounds vertices to a grid of 2⁻ᵇ pixel. A vertex moves
// by less than one step along each axis, whether it is rounded or truncated, and an edge by less
// than √2 steps. Two steps cover that, and for 7 bits or more the margin does.
[[nodiscard]] double sprite_growth(int sub_pixel_bits);

}  // namespace triptych::technique
