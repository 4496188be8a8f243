#pragma once
#include <cmath>
#include <cstdint>

namespace triptych::technique {

// Returns the width and height of the largest square image with at most this many pixels.
[[nodiscard]] inline std::uint64_t largest_square(std::uint64_t pixels) {
  auto edge = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(pixels)));
  // Corrects the rounding of the square root.
  while (edge > 0 && edge > pixels / edge) --edge;
  while (edge + 1 <= pixels / (edge + 1)) ++edge;
  return edge;
}

}  // namespace triptych::technique
