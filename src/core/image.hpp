#pragma once
// The image type that all parts of the program use.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych::core {

// Linear float RGBA, premultiplied, row-major, top row first: pixel (x, y) begins at
// 4·(y·width + x). Images of particles also have the depth (distance along the view axis in world
// units, +inf for none) and the index of the particle in its file (no_particle for none). Both are
// empty in other images.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgba;
  std::vector<float> depth;
  std::vector<std::uint32_t> ids;

  static constexpr std::uint32_t no_particle = 0xFFFFFFFFu;

  Image() = default;
  Image(int w, int h)
      : width(w),
        height(h),
        rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.0F) {}

  [[nodiscard]] std::size_t pixel_count() const noexcept {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::array<float, 4> pixel(int x, int y) const {
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x));
    return {rgba.at(i), rgba.at(i + 1), rgba.at(i + 2), rgba.at(i + 3)};
  }
  bool operator==(const Image&) const = default;
};

}  // namespace triptych::core
