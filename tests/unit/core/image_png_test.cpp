#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "support/temporary_folder.hpp"

namespace triptych::core {
namespace {

struct DecodedPng {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;
};

// Decodes the image with libpng.
DecodedPng decode_png(const std::vector<std::byte>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0) << png.message;
  EXPECT_EQ(png.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB, 0U);
  png.format = PNG_FORMAT_RGB;
  DecodedPng decoded{png.width, png.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  EXPECT_NE(png_image_finish_read(&png, nullptr, decoded.rgb.data(), 0, nullptr), 0) << png.message;
  return decoded;
}

Image row(const std::vector<std::array<float, 4>>& pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::copy(pixels[i].begin(), pixels[i].end(), image.rgba.begin() + std::ptrdiff_t(4 * i));
  }
  return image;
}

// Known values of the sRGB curve: linear 0.2140 corresponds to 127.5 of 255, and linear 0.5 to 188.
TEST(Png, EncodesTheSrgbCurve) {
  const Image image =
      row({{0, 0.5F, 1, 1}, {0.001F, 0.2122F, 0.2158F, 1}, {-1, 2, 0.0031308F, 0.25F}});
  const DecodedPng decoded = decode_png(encode_png(image));
  EXPECT_EQ(decoded.rgb, (std::vector<std::uint8_t>{0, 188, 255, 3, 127, 128, 0, 255, 10}));
}

TEST(Png, ShowsPremultipliedColourOverBlack) {
  const DecodedPng decoded = decode_png(encode_png(row({{0.5F, 0, 0, 0.5F}})));
  EXPECT_EQ(decoded.rgb, (std::vector<std::uint8_t>{188, 0, 0}));
}

TEST(Png, ShowsNanAsMagentaAndInfinityAsItsBound) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const DecodedPng decoded =
      decode_png(encode_png(row({{nan, 0, 0, 1}, {0, 0, 0, nan}, {inf, -inf, 0, 1}})));
  EXPECT_EQ(decoded.rgb, (std::vector<std::uint8_t>{255, 0, 255, 255, 0, 255, 255, 0, 0}));
}

TEST(Png, KeepsTheTopRowFirst) {
  Image image(2, 3);
  image.rgba[0] = 1;  // red in the top left corner
  const DecodedPng decoded = decode_png(encode_png(image));
  EXPECT_EQ(decoded.width, 2U);
  EXPECT_EQ(decoded.height, 3U);
  EXPECT_EQ(decoded.rgb[0], 255);
  EXPECT_EQ(std::count(decoded.rgb.begin(), decoded.rgb.end(), 0), 17);
}

TEST(Png, RejectsImagesWithoutPixelsOrOfWrongLength) {
  EXPECT_THROW((void)encode_png(Image{}), InputError);
  Image image(4, 4);
  image.rgba.pop_back();
  EXPECT_THROW((void)encode_png(image), InputError);
}

TEST(Png, ReportsAnUnwritableFile) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_png(Image(2, 2), folder.path() / "no" / "a.png"), IoError);
  write_png(Image(2, 2), folder.path() / "a.png");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.png"));
}

}  // namespace
}  // namespace triptych::core
