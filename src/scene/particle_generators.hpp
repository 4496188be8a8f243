#pragma once
// Seeded particle generators: the same bits on every machine, compiler and standard library
// (core/random.hpp, scene/exact_math.hpp). Each takes a count from 1 to 20 million.
//
// clang-format off
//   uniform    uniformly in [0, 10]³ (centres), equal radii that fill a tenth of the box:
//              count·(4/3)πr³ = 0.1·10³ (the paper's artificial sets; other fillings by radius_scale)
//   droplets   three dense droplets of different size in a mostly empty box 20×10×10, with thin vapour
//              between them
//   layer      a liquid layer across the middle of a long box 5×5×40, vapour on both sides
//   plume      an ablation plume: a slab of lattice sites with a crater, and above it an expanding cone of
//              clusters and single particles whose density falls with height
//   coincident every position eight times, with the same radius and different colours: ties
//   wall       a lattice in the front face of the cube, without a gap, all of it seen from +z
//   hidden     the wall of a tenth of COUNT and the others behind it, where nobody sees them; the
//              same box as `wall:COUNT/10`
// clang-format on
// Radii are equal within a set but for `plume`, whose clusters are up to twice as large, and behind
// a wall. Colours:
// rgba8 and rgba32 random hues (rgba32 not rounded to bytes), intensity from the position.

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/generators.hpp"
#include "scene/particles.hpp"

namespace triptych::scene {

// The generators above, in that order.
[[nodiscard]] std::vector<GeneratorInfo> particle_generators();

// Throws InputError for an unknown name or a count out of range. Generates nothing.
void check_particle_generator(std::string_view name, std::uint64_t count);

// Throws as check_particle_generator does. The name of the set is generate:NAME:COUNT.
[[nodiscard]] ParticleSet generate_particles(std::string_view name, std::uint64_t count,
                                             ColourKind colour, const Progress& progress = {});

}  // namespace triptych::scene
