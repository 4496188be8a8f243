#pragma once
#include <string_view>

namespace triptych::technique {

// Returns the number of pixels to add to the size of a point so that the device draws at least the
// intended square (TRI_POINT_MARGIN). Devices may round the size down to a multiple of
// `granularity`; a few drivers, which this function recognizes by `renderer`, are known to behave
// differently. `renderer` is the driver's name as the API reports it.
[[nodiscard]] double point_margin(std::string_view renderer, double granularity);

// Returns the number of pixels by which a sprite must grow on each side (TRI_SPRITE_GROWTH), in
// addition to its margin of 1/64 pixel, if the device rounds vertices to a grid of 2⁻ᵇ pixel, where
// b is `sub_pixel_bits`. Whether a vertex is rounded or truncated, it moves by less than one grid
// step along each axis, so an edge moves by less than √2 steps. Two steps cover this. If b is 7 or
// more, the margin alone is sufficient.
[[nodiscard]] double sprite_growth(int sub_pixel_bits);

}  // namespace triptych::technique
