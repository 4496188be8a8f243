#pragma once
// An injected slowdown by real work: a part of the image once more, in the same launch, as a launch
// of its own would cost more than its share of the work.

#include <vector>

namespace triptych::technique {

// The tiles in which work is done again.
inline constexpr int extra_tile_width = 16;
inline constexpr int extra_tile_height = 8;

// The first column of a grid that draws something once more: tri_drawn_column's `again`
// (portable/volume_math.h).
[[nodiscard]] constexpr int again_from(int width) {
  return (width + extra_tile_width - 1) / extra_tile_width * extra_tile_width;
}

// Columns of a grid that draws an image of `width` columns and a share of 1/stride of it again; the
// image's own for stride 0.
[[nodiscard]] constexpr int drawn_columns(int width, int stride) {
  if (stride == 0) return width;
  const int tiles = again_from(width) / extra_tile_width;
  return again_from(width) + (tiles + stride - 1) / stride * extra_tile_width;
}

// Pixels that a launch over drawn_columns × height leaves behind (tri_output_place).
[[nodiscard]] constexpr long long drawn_pixels(int width, int height, int stride) {
  const long long again = stride == 0 ? 0 : drawn_columns(width, stride) - again_from(width);
  return (width + again) * height;
}

// The same tiles as rectangles of the image, for what draws into a target.
struct ExtraTile {
  int x, y, width, height;
};
[[nodiscard]] std::vector<ExtraTile> extra_tiles(int width, int height, int stride);

}  // namespace triptych::technique
