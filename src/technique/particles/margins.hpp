#pragma once
#include <string_view>

namespace triptych::technique {

// The number of pixels to add to the size of a point so that the device draws at least the intended
// square (TRI_POINT_MARGIN). Sizes are multiples of `granularity` and may be rounded down to one,
// except on drivers that are known to behave differently. `renderer` is the API's name of the
// driver.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

// The number of pixels by which a sprite must be larger on each side, in addition to its margin of
// 1/64 (TRI_SPRITE_GROWTH), on a device that rounds vertices to a grid of 2⁻ᵇ pixel. Whether a
// vertex is rounded or truncated, it moves by less than one step along each axis, and an edge by
// less than √2 steps. Two steps cover that. For 7 bits or more, the margin already does.
[[nodiscard]] double sprite_growth(int sub_pixel_bits);

}  // namespace triptych::technique
