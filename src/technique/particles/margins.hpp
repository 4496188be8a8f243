#pragma once
#include <string_view>

namespace triptych::technique {

// Pixels to add to the size of a point so that the device draws no less than the square that was
// meant (TRI_POINT_MARGIN). Sizes are multiples of `granularity` and may be rounded down to one,
// but by the drivers that are known to do otherwise, which `renderer` names in the API's own words.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

// Pixels that a sprite is larger than the silhouette on each side (TRI_SPRITE_MARGIN), on a device
// that moves vertices to a grid of 2⁻ᵇ pixel. A vertex moves by less than a step along each axis,
// whether it is rounded or cut off, and an edge across by less than √2 of them: two cover it. 1/64
// at least, which is two steps of 7 bits, covers the arithmetic as well.
[[nodiscard]] double sprite_margin(int sub_pixel_bits);

}  // namespace triptych::technique
