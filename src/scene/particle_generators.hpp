#pragma once
// Seeded particle generators, whose results are bit-identical for every machine, compiler and
// standard library (core/random.hpp, scene/exact_math.hpp). Each takes a count from 1 to 20
// million.
//
// clang-format off
//   uniform    centres uniformly distributed in [0, 10]³; equal radii such that the spheres fill a tenth
//              of the box: count·(4/3)πr³ = 0.1·10³ (like the artificial data sets in the paper of Bruder et
//              al., see docs/paper.md; radius_scale produces other filling fractions)
//   droplets   three dense droplets of different sizes in a mostly empty box 20×10×10, with thin vapour
//              between them
//   layer      a liquid layer across the middle of a long box 5×5×40, with vapour on both sides
//   plume      an ablation plume: a slab of lattice sites with a crater, and above it an expanding
//              cone of clusters and single particles whose density decreases with height
//   coincident every position occurs eight times, with the same radius and different colours, so that depths tie
//   wall       a lattice without gaps in the front face of the cube [0, 10]³; all of it is visible from +z
//   hidden     a wall that consists of a tenth of the particles, with all other particles hidden behind it; its bounding
//              box is the same as that of `wall:COUNT/10`
// clang-format on
// Radii are equal within a set, except in `plume`, whose clusters have radii up to twice as large,
// and in sets with particles behind a wall. Colours in rgba8 and rgba32 are random hues (rgba32 is
// not rounded to bytes). The intensity is derived from the position.

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/generators.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// Returns the generators above, in that order.
[[nodiscard]] std::vector<GeneratorInfo> particle_generators();

// Throws InputError for an unknown name or a count out of range. Does not generate any particles.
void check_particle_generator(std::string_view name, std::uint64_t count);

// Generates a set, whose name is generate:NAME:COUNT. Throws the same exceptions as
// check_particle_generator().
[[nodiscard]] ParticleSet generate_particles(std::string_view name, std::uint64_t count,
                                             ColourKind colour, const Progress& progress = {});

}  // namespace triptych::scene
