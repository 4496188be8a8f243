#pragma once
// 8-bit images for display.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.hpp"

namespace triptych::core {

// An 8-bit sRGB image in row-major order, top row first.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // three values for each pixel
};

// Converts an image to the 8-bit pixels that write_png() stores. The image is composited over black
// and clamped to [0, 1]. NaN becomes magenta.
[[nodiscard]] RgbImage to_srgb(const Image& image);

// Throws InputError if the image is empty or `rgb` does not have three values for each pixel.
[[nodiscard]] std::vector<std::byte> encode_png(const RgbImage& image);

}  // namespace triptych::core
