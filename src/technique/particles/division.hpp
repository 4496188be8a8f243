#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::technique {

// A regular grid over the centres, with approximately cubic cells.
class Grid {
 public:
  // Makes cells for about `per_cell` evenly distributed particles each.
  Grid(const scene::ParticleSet& set, std::size_t per_cell);

  [[nodiscard]] double edge() const { return edge_; }
  [[nodiscard]] std::uint32_t cells() const { return counts_[0] * counts_[1] * counts_[2]; }
  [[nodiscard]] std::uint32_t cell_of(const std::array<float, 4>& sphere) const;

 private:
  glm::dvec3 lo_{};
  double edge_ = 1;
  std::array<std::uint32_t, 3> counts_{1, 1, 1};
};

// Divides space according to the particles in it: the cells of a grid, and a cell in two,
// repeatedly, if its particles are so uneven that it pays. For example, a wall is separated from
// the particles behind it.
//
// The cost of a box with n particles is n times the probability that it is visible, which is
// proportional to its surface area (the surface area heuristic of MacDonald and Booth, Heuristics
// for ray tracing using space subdivision, 1990). A plane pays if n·A exceeds n₁·A₁ + n₂·A₂ by at
// least half a cell's particles times A, where A is the surface area of a box around spheres. Each
// half of a cube has two thirds of its surface, so cells with evenly distributed particles are not
// divided until they have one and a half times the intended number.
class Division {
 public:
  // Takes four bytes per particle while it divides.
  Division(const scene::ParticleScene& scene, std::size_t per_cell);

  // The part that contains the set's particle with this index. Part 0 contains particles that are
  // wider than a cell of the grid. Coincident centres are in one part, except for those in part 0.
  [[nodiscard]] std::uint32_t part_of(std::uint32_t place) const;
  // The number of parts, some of which are empty.
  [[nodiscard]] std::size_t parts() const { return nodes_.size(); }

 private:
  // A part, or a place where space is divided according to whether centres lie below a plane. The
  // parts of the grid come first, after part 0.
  struct Node {
    static constexpr std::uint32_t whole = 3;
    std::uint32_t axis = whole;
    float plane = 0;
    std::uint32_t below = 0;  // the other side is the next node
  };
  struct Crowd {
    std::uint32_t node = 0;
    std::span<std::uint32_t> places;
  };

  [[nodiscard]] std::uint32_t undivided_part_of(std::uint32_t place) const;
  void divide(Crowd all);

  const scene::ParticleScene& scene_;
  Grid grid_;
  double price_;  // the price of a part, in particles
  std::vector<Node> nodes_;
};

}  // namespace triptych::technique
