#include "technique/volume/extra_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

std::vector<std::pair<int, int>> drawn(int width, int height, int stride) {
  std::vector<std::pair<int, int>> pixels;
  for (int y = 0; y < extra_rows(height, stride); ++y) {
    for (int x = 0; x < width; ++x) {
      const int row = portable::tri_drawn_row(x, y, stride);
      if (row < height) pixels.emplace_back(x, row);
    }
  }
  return pixels;
}

TEST(ExtraWork, TheGridOfThePictureIsThePicture) {
  for (int y = 0; y < 2048; ++y) EXPECT_EQ(portable::tri_drawn_row(7 * y % 2048, y, 1), y);
  EXPECT_EQ(extra_rows(192, 0), 0);
}

TEST(ExtraWork, NoPixelIsDrawnTwiceAndTheShareIsAsAsked) {
  for (const int size : {96, 192, 320, 512}) {
    for (const int stride : {1, 4, 5, 10, 20, 33, 50, 100}) {
      const auto pixels = drawn(size, size, stride);
      const std::set<std::pair<int, int>> once(pixels.begin(), pixels.end());
      EXPECT_EQ(once.size(), pixels.size());
      const double tiles = size * size / 128.0;
      const double share = static_cast<double>(pixels.size()) / (size * size);
      // The golden ratio's multiples deal up to 32 columns evenly to within two tiles.
      EXPECT_NEAR(share, 1.0 / stride, 2 / tiles + 1e-12) << size << " pixels, stride " << stride;
    }
  }
}

// The middle of a picture is where rays are long: no quarter may have all of the extra work.
TEST(ExtraWork, IsSpreadOverThePicture) {
  for (const int stride : {5, 10, 20, 33}) {
    const auto pixels = drawn(512, 512, stride);
    const auto inner = std::ranges::count_if(pixels, [](const auto& pixel) {
      return std::abs(pixel.first - 256) < 128 && std::abs(pixel.second - 256) < 128;
    });
    EXPECT_NEAR(static_cast<double>(inner) / static_cast<double>(pixels.size()), 0.25, 0.06)
        << "stride " << stride;
  }
}

}  // namespace
}  // namespace triptych::technique
