#pragma once
// Particles in the order in which every technique on every API draws them. Made when a scene is
// prepared; no part of any timing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::technique {

// A run of particles and the box around their spheres. Mirrors parameters.glsl (std430) and
// parameters.cl.
struct Cell {
  std::array<float, 3> lo{};
  std::uint32_t begin = 0;
  std::array<float, 3> hi{};
  std::uint32_t count = 0;
};
static_assert(sizeof(Cell) == 32);

// One draw order for all: cells of a regular grid front to back as seen from the eye, and in a cell
// by ascending id. A depth test that keeps the first of equals, or a comparison of indices into
// these arrays, then resolves every tie in the same way on every device, whatever is culled, and
// coincident spheres (one cell) show the lowest id. It does not depend on the order in which the
// set holds its particles. A sphere with a diameter of more than the edge of a cell is put apart,
// into the first cells, so that no box grows by it.
struct Arrangement {
  std::vector<std::array<float, 4>> spheres;  // centre and radius as drawn (radius_scale applied)
  std::vector<std::uint32_t> ids;
  scene::ColourKind colour = scene::ColourKind::rgba8;
  std::vector<std::uint32_t> rgba8;  // as ParticleSet: one of the three
  std::vector<std::array<float, 4>> rgba32;
  std::vector<float> intensity;
  std::vector<Cell> cells;

  [[nodiscard]] std::size_t count() const noexcept { return spheres.size(); }
};

// About this many particles to a cell where they are spread evenly: enough that drawing a cell pays
// for having tested it, few enough that culling follows the view.
inline constexpr std::size_t particles_per_cell = 512;

// Beside the set and the result it never holds more than a hundredth of either, so that the two
// together are the most memory that it takes.
[[nodiscard]] Arrangement arrange(const scene::ParticleScene& scene);

}  // namespace triptych::technique
