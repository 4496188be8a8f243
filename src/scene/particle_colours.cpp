#include "scene/particle_colours.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::scene {

std::uint32_t rgba8_of(const Rgb& rgb) {
  std::uint32_t packed = 0xFF000000U;
  for (unsigned channel = 0; channel < 3; ++channel) {
    const double value = std::clamp(rgb.at(channel), 0.0, 1.0);
    packed |= static_cast<std::uint32_t>(std::floor(value * 255 + 0.5)) << (8 * channel);
  }
  return packed;
}

std::array<float, 4> rgba32_of(const Rgb& rgb) {
  return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]), 1};
}

Rgb hue_colour(double hue, double saturation) {
  Rgb rgb{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    // The distance between `hue` and the channel's own hue, in sextants (sixths of the colour
    // circle).
    const double offset = std::abs(hue * 6 - 2.0 * static_cast<double>(channel));
    const double distance = std::min(offset, 6 - offset);
    rgb.at(channel) = 1 - saturation * std::clamp(distance - 1, 0.0, 1.0);
  }
  return rgb;
}

void append_colour(ParticleSet& set, const Rgb& rgb, double intensity) {
  switch (set.colour) {
    case ColourKind::rgba8:
      set.rgba8.push_back(rgba8_of(rgb));
      break;
    case ColourKind::rgba32:
      set.rgba32.push_back(rgba32_of(rgb));
      break;
    case ColourKind::intensity:
      set.intensity.push_back(static_cast<float>(std::clamp(intensity, 0.0, 1.0)));
      break;
  }
}

void reserve(ParticleSet& set, std::size_t count) {
  set.spheres.reserve(count);
  set.ids.reserve(count);
  switch (set.colour) {
    case ColourKind::rgba8:
      set.rgba8.reserve(count);
      break;
    case ColourKind::rgba32:
      set.rgba32.reserve(count);
      break;
    case ColourKind::intensity:
      set.intensity.reserve(count);
      break;
  }
}

}  // namespace triptych::scene
