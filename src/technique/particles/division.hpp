#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::technique {

// A regular grid over the centres, of about cubic cells.
class Grid {
 public:
  // Cells for about `per_cell` particles each where they are spread evenly.
  Grid(const scene::ParticleSet& set, std::size_t per_cell);

  [[nodiscard]] double edge() const { return edge_; }
  [[nodiscard]] std::uint32_t cells() const { return counts_[0] * counts_[1] * counts_[2]; }
  [[nodiscard]] std::uint32_t cell_of(const std::array<float, 4>& sphere) const;

 private:
  glm::dvec3 lo_{};
  double edge_ = 1;
  std::array<std::uint32_t, 3> counts_{1, 1, 1};
};

// Space in parts by the particles in it: the cells of a grid, and such a cell in two, again and
// again, where its particles lie so unevenly that it pays: a wall is parted from what is behind it.
//
// What a box of n particles costs is n times how often it is in sight, which grows as its surface
// (the surface area heuristic of MacDonald and Booth, Heuristics for ray tracing using space
// subdivision, 1990). A plane pays where n·A exceeds n₁·A₁ + n₂·A₂ by at least half a cell's
// particles times A, A being the surface of a box around spheres. Halves of a cube have two thirds
// of its surface each, so that evenly spread particles are left in peace up to one and a half times
// the grid's number.
class Division {
 public:
  // Takes four bytes a particle while it divides.
  Division(const scene::ParticleScene& scene, std::size_t per_cell);

  // The part in which the set's particle at this place is. 0: it is wider than a cell of the grid.
  // Coincident centres are in one part, except for those in 0.
  [[nodiscard]] std::uint32_t part_of(std::uint32_t place) const;
  // Some are empty.
  [[nodiscard]] std::size_t parts() const { return nodes_.size(); }

 private:
  // A part, or where it is divided: by whether its centres lie below a plane. Those of the grid
  // come first, behind the part 0.
  struct Node {
    static constexpr std::uint32_t whole = 3;
    std::uint32_t axis = whole;
    float plane = 0;
    std::uint32_t below = 0;  // the other side's comes next
  };
  struct Crowd {
    std::uint32_t node = 0;
    std::span<std::uint32_t> places;
  };

  [[nodiscard]] std::uint32_t undivided_part_of(std::uint32_t place) const;
  void divide(Crowd all);

  const scene::ParticleScene& scene_;
  Grid grid_;
  double price_;  // of a part, in particles
  std::vector<Node> nodes_;
};

}  // namespace triptych::technique
