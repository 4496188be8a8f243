#pragma once
// The drawing order of the particles, which is the same for all techniques and all APIs. It is
// computed when a scene is prepared, outside all timed code.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::technique {

// A cell: about 512 neighbouring particles, which are consecutive in the drawing order
// (Arrangement), and the box around their spheres. `begin` is the index of the first particle in
// that order. The layout is the same as in cells.glsl (std430) and in the OpenCL kernels.
struct Cell {
  std::array<float, 3> lo{};
  std::uint32_t begin = 0;
  std::array<float, 3> hi{};
  std::uint32_t count = 0;
};
static_assert(sizeof(Cell) == 32);

// The data of each particle on a device, one array for each property.
enum class Property : std::uint8_t {
  sphere,  // four floats: centre, and radius with radius_scale applied
  colour,  // in the format of the set: four bytes, four floats, or one float
  id       // four bytes
};

// One drawing order for all techniques: the cells (groups of neighbouring particles) are sorted
// from front to back as seen from the eye, and the particles of each cell by ascending id. The
// cells are those of a regular grid, subdivided where that saves work (division.hpp).
//
// Ties in depth are resolved by this order, either by a depth test that keeps the first of equal
// depths or by comparing indices. Every device therefore resolves ties in the same way, regardless
// of culling. Coincident spheres are in one cell, and the one with the lowest id is visible. The
// order does not depend on the order of the particles in the set.
//
// Spheres whose diameter exceeds the edge length of a grid cell are put into the first cells, so
// that they do not enlarge the boxes of other cells.
//
// Properties stay in the set and are gathered while they are copied to a device, because a second
// copy of ten million particles would take too much memory.
struct Arrangement {
  std::shared_ptr<const scene::ParticleSet> particles;
  double radius_scale = 1;
  std::vector<std::uint32_t> order;  // indices of particles in the set
  std::vector<Cell> cells;           // each cell is a range of `order`

  [[nodiscard]] std::size_t count() const noexcept { return order.size(); }

  // Returns the sphere of the k-th particle in this order, with radius_scale applied.
  [[nodiscard]] std::array<float, 4> sphere(std::size_t k) const {
    std::array<float, 4> sphere = particles->spheres[order[k]];
    sphere[3] = scene::scaled_radius(sphere[3], radius_scale);
    return sphere;
  }
  [[nodiscard]] std::uint32_t id(std::size_t k) const { return particles->ids[order[k]]; }

  // Returns the size of the property in bytes per particle.
  [[nodiscard]] std::size_t element_bytes(Property property) const;
  [[nodiscard]] std::size_t bytes(Property property) const {
    return element_bytes(property) * count();
  }
  // Fills `out` with the bytes of the property's array that start at byte `begin`. Both `begin` and
  // the size of `out` must be multiples of element_bytes(property); `out` need not be aligned.
  void copy(Property property, std::size_t begin, std::span<std::byte> out) const;
};

// The approximate number of particles in a cell if they are evenly distributed. It is large enough
// that culling a cell saves more than its visibility test costs, and small enough that the cells
// that remain fit the view closely.
inline constexpr std::size_t particles_per_cell = 512;

// Sorts the particles into cells. In addition to the result, this temporarily needs about one
// hundredth of the set's memory and, if the ids in the set are not ascending, another array as
// large as `order`.
[[nodiscard]] Arrangement arrange(const scene::ParticleScene& scene);

}  // namespace triptych::technique
