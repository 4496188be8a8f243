#pragma once
// Particle colours, in each of the formats that a particle set can store (ColourKind).

#include <array>
#include <cstdint>

#include "scene/particles.hpp"

namespace triptych::scene {

using Rgb = std::array<double, 3>;  // not premultiplied; each channel is in [0, 1]

// Converts a colour to 8 bits per channel, opaque, with red in the lowest byte. Values outside [0,
// 1] are clamped.
[[nodiscard]] std::uint32_t rgba8_of(const Rgb& rgb);
[[nodiscard]] std::array<float, 4> rgba32_of(const Rgb& rgb);

// Returns the colour for a hue in turns, 0 ≤ hue ≤ 1. The hue 0 is red, ⅓ is green and ⅔ is blue.
[[nodiscard]] Rgb hue_colour(double hue, double saturation = 0.75);

// Appends the colour of the most recently appended particle, in the set's colour format. The
// intensity is clamped to [0, 1].
void append_colour(ParticleSet& set, const Rgb& rgb, double intensity);

// Reserves memory for `count` particles in the arrays that the set's colour format uses.
void reserve(ParticleSet& set, std::size_t count);

}  // namespace triptych::scene
