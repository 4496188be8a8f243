#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_io.hpp"
#include "core/rgb_image.hpp"

namespace triptych::core {
namespace {

// The sRGB transfer function (IEC 61966-2-1), rounded to 8 bits.
std::uint8_t srgb8(float linear) {
  const double x = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

// Ignores alpha, because compositing over black does not change a premultiplied colour.
RgbImage to_srgb(const Image& image) {
  RgbImage rgb_image{image.width, image.height, {}};
  rgb_image.rgb.resize(3 * image.pixel_count());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float* in = image.rgba.data() + 4 * i;
    std::uint8_t* out = rgb_image.rgb.data() + 3 * i;
    if (std::any_of(in, in + 4, [](float c) { return std::isnan(c); })) {
      out[0] = 255;
      out[1] = 0;
      out[2] = 255;
    } else {
      std::transform(in, in + 3, out, srgb8);
    }
  }
  return rgb_image;
}

std::vector<std::byte> encode_png(const RgbImage& rgb_image) {
  const auto pixels =
      static_cast<std::size_t>(rgb_image.width) * static_cast<std::size_t>(rgb_image.height);
  if (rgb_image.width < 1 || rgb_image.height < 1 || rgb_image.rgb.size() != 3 * pixels) {
    throw InputError(
        fmt::format("cannot write a PNG image of {}x{} pixels: the number of RGB values does not "
                    "match ({})",
                    rgb_image.width, rgb_image.height, rgb_image.rgb.size()));
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(rgb_image.width);
  png.height = static_cast<png_uint_32>(rgb_image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, rgb_image.rgb.data(), 0, nullptr) ==
      0) {
    throw InputError(fmt::format("libpng cannot encode the image: {}", png.message));
  }
  bytes.resize(size);
  return bytes;
}

std::vector<std::byte> encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1 || image.rgba.size() != 4 * image.pixel_count()) {
    throw InputError(
        fmt::format("cannot write a PNG image of {}x{} pixels: the number of RGBA values does not "
                    "match ({})",
                    image.width, image.height, image.rgba.size()));
  }
  return encode_png(to_srgb(image));
}

void write_png(const Image& image, const std::filesystem::path& file) {
  write_file(encode_png(image), file);
}

}  // namespace triptych::core
