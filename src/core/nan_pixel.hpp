#pragma once
#include <algorithm>
#include <cmath>
#include <span>

namespace triptych::core {

// Returns whether all channels of the pixel are NaN. Outputs are filled with NaN before each frame,
// so such a pixel was probably not drawn. It may also be a NaN that the device computed.
[[nodiscard]] inline bool is_nan_pixel(std::span<const float, 4> pixel) {
  return std::ranges::all_of(pixel, [](float channel) { return std::isnan(channel); });
}

}  // namespace triptych::core
