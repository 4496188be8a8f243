#pragma once
#include <string_view>

namespace triptych::technique {

// Pixels to add to the size of a point so that the device draws no less than the square that was
// meant (TRI_POINT_MARGIN). Sizes are multiples of `granularity` and may be rounded down to one,
// but by the drivers that are known to do otherwise, which `renderer` names in the API's own words.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

// Pixels by which a sprite has to be larger on each side than by its margin of 1/64
// (TRI_SPRITE_GROWTH), on a device that moves vertices to a grid of 2⁻ᵇ pixel. A vertex moves by
// less than a step along each axis, whether it is rounded or cut off, and an edge across by less
// than √2 of them: two cover it, which from 7 bits on the margin does.
[[nodiscard]] double sprite_growth(int sub_pixel_bits);

}  // namespace triptych::technique
