#pragma once
// Particles in the order in which every technique on every API draws them. Made when a scene is
// prepared; no part of any timing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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

// What a device is given of each particle, one array per property.
enum class Property : std::uint8_t {
  sphere,  // four floats: centre and radius as drawn (radius_scale applied)
  colour,  // as in the set: four bytes, four floats, or one float
  id       // four bytes
};

// One draw order for all: cells front to back as seen from the eye, and in a cell by ascending id.
// They are those of a regular grid, divided where it pays (division.hpp). A depth test that keeps
// the first of equals, or a comparison of places in this order, then resolves every tie in the same
// way on every device, whatever is culled, and coincident spheres (one cell) show the lowest id. It
// does not depend on the order in which the set holds its particles. A sphere with a diameter of
// more than the edge of a cell is put apart, into the first cells, so that no box grows by it.
//
// Properties stay where the set has them and are gathered on their way to a device: of ten million
// particles the host cannot be asked to hold a second copy.
struct Arrangement {
  std::shared_ptr<const scene::ParticleSet> particles;
  double radius_scale = 1;
  std::vector<std::uint32_t> order;  // places in the set
  std::vector<Cell> cells;           // runs of `order`

  [[nodiscard]] std::size_t count() const noexcept { return order.size(); }

  // Of the k-th particle in this order.
  [[nodiscard]] std::array<float, 4> sphere(std::size_t k) const {
    std::array<float, 4> sphere = particles->spheres[order[k]];
    sphere[3] = scene::scaled_radius(sphere[3], radius_scale);
    return sphere;
  }
  [[nodiscard]] std::uint32_t id(std::size_t k) const { return particles->ids[order[k]]; }

  // Bytes of the property, for each particle and for all.
  [[nodiscard]] std::size_t element_bytes(Property property) const;
  [[nodiscard]] std::size_t bytes(Property property) const {
    return element_bytes(property) * count();
  }
  // Writes the part of the property's array that begins at byte `begin`. `begin` and the size of
  // `out`, which need not be aligned, are multiples of element_bytes.
  void copy(Property property, std::size_t begin, std::span<std::byte> out) const;
};

// About this many particles to a cell where they are spread evenly: enough that drawing a cell pays
// for having tested it, few enough that culling follows the view.
inline constexpr std::size_t particles_per_cell = 512;

// Beside the set it takes the memory of its result and about a hundredth of the set's; while it
// works, the order's once more where the set's ids do not ascend.
[[nodiscard]] Arrangement arrange(const scene::ParticleScene& scene);

}  // namespace triptych::technique
