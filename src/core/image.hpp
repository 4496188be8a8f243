#pragma once
// The image type used by all parts of the program.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych::core {

// An image with linear, premultiplied float RGBA in row-major order, top row first. Pixel (x, y)
// begins at rgba[4·(y·width + x)]. Images of particles also have two values per pixel that belong
// to the visible particle: its depth (the distance along the view axis in world units) and its id
// (see ParticleSet::ids in scene/particles.hpp). Where no particle is visible, these values are
// +inf and no_particle. In other images, `depth` and `ids` are empty.
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
