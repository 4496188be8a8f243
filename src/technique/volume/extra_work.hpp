#pragma once
// Injects a slowdown that consists of real work: a part of the image is drawn again in the same
// launch, because a separate launch would cost more than its share of the work.

#include <vector>

namespace triptych::technique {

// The size of the tiles that are drawn again, in pixels.
inline constexpr int extra_tile_width = 16;
inline constexpr int extra_tile_height = 8;

// Returns the first column of a launch that draws a part of the image again, which is the argument
// `again` of tri_drawn_column (portable/volume_math.h).
[[nodiscard]] constexpr int again_from(int width) {
  return (width + extra_tile_width - 1) / extra_tile_width * extra_tile_width;
}

// Returns the number of columns of a launch that draws an image of `width` columns and repeats
// 1/stride of it. If stride is 0, nothing is repeated.
[[nodiscard]] constexpr int drawn_columns(int width, int stride) {
  if (stride == 0) return width;
  const int tiles = again_from(width) / extra_tile_width;
  return again_from(width) + (tiles + stride - 1) / stride * extra_tile_width;
}

// Returns the number of pixels that a launch of drawn_columns × height writes (tri_output_place).
[[nodiscard]] constexpr long long drawn_pixels(int width, int height, int stride) {
  const long long again = stride == 0 ? 0 : drawn_columns(width, stride) - again_from(width);
  return (width + again) * height;
}

// The repeated tiles as rectangles of the image, for techniques that draw into a render target.
struct ExtraTile {
  int x, y, width, height;
};
[[nodiscard]] std::vector<ExtraTile> extra_tiles(int width, int height, int stride);

}  // namespace triptych::technique
