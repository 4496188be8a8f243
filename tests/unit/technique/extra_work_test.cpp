#include "technique/volume/extra_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

using Pixels = std::vector<std::pair<int, int>>;

// Returns the pixels that a launch draws a second time, row by row and from left to right in the
// grid of the launch.
Pixels drawn_again(int width, int height, int stride) {
  Pixels pixels;
  const int again = again_from(width);
  for (int y = 0; y < height; ++y) {
    for (int x = again; x < drawn_columns(width, stride); ++x) {
      const int column = portable::tri_drawn_column(x, y, again, stride);
      if (column < width) pixels.emplace_back(column, y);
    }
  }
  return pixels;
}

TEST(ExtraWork, TheFirstPartOfTheGridIsTheImage) {
  for (const int width : {1, 16, 97, 2048}) {
    for (int x = 0; x < width; ++x) {
      EXPECT_EQ(portable::tri_drawn_column(x, 7 * x % 2048, again_from(width), 5), x);
    }
    EXPECT_EQ(drawn_columns(width, 0), width);
    EXPECT_EQ(drawn_pixels(width, 3, 0), 3 * width);
    EXPECT_TRUE(extra_tiles(width, 64, 0).empty());
  }
}

TEST(ExtraWork, NoPixelIsDrawnTwiceAndTheShareIsAsAsked) {
  for (const int size : {96, 192, 320, 512}) {
    for (const int stride : {1, 4, 5, 10, 20, 33, 50, 100}) {
      const Pixels pixels = drawn_again(size, size, stride);
      const std::set<std::pair<int, int>> once(pixels.begin(), pixels.end());
      EXPECT_EQ(once.size(), pixels.size());
      const double tiles = size * size / 128.0;
      const double share = static_cast<double>(pixels.size()) / (size * size);
      // From row to row, the repeated tiles are shifted by the golden ratio. This distributes them
      // so evenly that, for up to 64 rows, their number is off by at most three.
      EXPECT_NEAR(share, 1.0 / stride, 3 / tiles + 1e-12) << size << " pixels, stride " << stride;
    }
  }
}

// A driver may statically assign half of the rows to each of two CPU cores, so both halves need
// equal work.
TEST(ExtraWork, IsDistributedOverBothHalves) {
  for (const int size : {192, 320, 512}) {
    for (const int stride : {5, 10, 20, 33}) {
      const Pixels pixels = drawn_again(size, size, stride);
      const auto upper =
          std::ranges::count_if(pixels, [&](const auto& pixel) { return pixel.second < size / 2; });
      const double tiles = static_cast<double>(pixels.size()) / 128;
      EXPECT_NEAR(static_cast<double>(upper) / 128, tiles / 2, 1.5)
          << size << " pixels, stride " << stride;
    }
  }
}

// Rays are longest in the middle of an image, so the middle must receive its share of the extra
// work.
TEST(ExtraWork, IsDistributedOverTheImage) {
  for (const int stride : {5, 10, 20, 33}) {
    const Pixels pixels = drawn_again(512, 512, stride);
    const auto inner = std::ranges::count_if(pixels, [](const auto& pixel) {
      return std::abs(pixel.first - 256) < 128 && std::abs(pixel.second - 256) < 128;
    });
    EXPECT_NEAR(static_cast<double>(inner) / static_cast<double>(pixels.size()), 0.25, 0.06)
        << "stride " << stride;
  }
}

TEST(ExtraWork, NoOutputIsWrittenTwice) {
  for (const auto& [width, height, stride] : {std::array{97, 33, 4}, std::array{192, 192, 20}}) {
    std::set<int> places;
    const int columns = drawn_columns(width, stride);
    const int again = again_from(width);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < columns; ++x) {
        if (portable::tri_drawn_column(x, y, again, stride) >= width) continue;
        const int place = portable::tri_output_place(x, y, width, height, again, columns);
        EXPECT_TRUE(places.insert(place).second) << x << ", " << y;
        EXPECT_LT(place, drawn_pixels(width, height, stride));
        if (x < width) {
          EXPECT_EQ(place, y * width + x);
        }
      }
    }
  }
}

TEST(ExtraWork, TilesCoverTheSamePixels) {
  for (const auto& [width, height] : {std::pair{97, 33}, std::pair{192, 192}}) {
    Pixels tiled;
    for (const ExtraTile& tile : extra_tiles(width, height, 5)) {
      for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) tiled.emplace_back(x, y);
      }
    }
    Pixels launched = drawn_again(width, height, 5);
    std::ranges::sort(tiled);
    std::ranges::sort(launched);
    EXPECT_EQ(tiled, launched);
  }
}

}  // namespace
}  // namespace triptych::technique
