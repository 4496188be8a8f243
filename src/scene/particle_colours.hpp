#pragma once
// Colours of particles in each of the kinds a set can hold.

#include <array>
#include <cstdint>

#include "scene/particles.hpp"

namespace triptych::scene {

using Rgb = std::array<double, 3>;  // straight, each in [0, 1]

// The nearest bytes, red in the lowest, opaque. Values outside [0, 1] are clamped.
[[nodiscard]] std::uint32_t rgba8_of(const Rgb& rgb);
[[nodiscard]] std::array<float, 4> rgba32_of(const Rgb& rgb);

// A colour of the given hue, in turns from red over green and blue; 0 ≤ hue ≤ 1.
[[nodiscard]] Rgb hue_colour(double hue, double saturation = 0.75);

// Appends the colour of the particle that was just appended, in the set's kind. Intensity is
// clamped to [0, 1].
void append_colour(ParticleSet& set, const Rgb& rgb, double intensity);

// Room for so many particles in the arrays that the set's kind fills.
void reserve(ParticleSet& set, std::size_t count);

}  // namespace triptych::scene
