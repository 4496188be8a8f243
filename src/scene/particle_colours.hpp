#pragma once
// The colours of particles, in each form that a set of particles can contain.

#include <array>
#include <cstdint>

#include "scene/particles.hpp"

namespace triptych::scene {

using Rgb = std::array<double, 3>;  // not premultiplied, each in [0, 1]

// The colour in 8 bits per channel, opaque, with red in the lowest byte. Values outside [0, 1] are
// clamped.
[[nodiscard]] std::uint32_t rgba8_of(const Rgb& rgb);
[[nodiscard]] std::array<float, 4> rgba32_of(const Rgb& rgb);

// The colour of a hue in turns, 0 ≤ hue ≤ 1: 0 is red, ⅓ is green and ⅔ is blue.
[[nodiscard]] Rgb hue_colour(double hue, double saturation = 0.75);

// Appends the colour of the particle that was appended last, in the kind of the set. Intensity is
// clamped to [0, 1].
void append_colour(ParticleSet& set, const Rgb& rgb, double intensity);

// Reserves memory for this many particles in the arrays that the kind of the set fills.
void reserve(ParticleSet& set, std::size_t count);

}  // namespace triptych::scene
