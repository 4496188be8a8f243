#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::technique {

// A regular grid of cubic cells over the spheres' centres.
class Grid {
 public:
  // Chooses cells that would contain about `per_cell` particles each if the particles were evenly
  // distributed.
  Grid(const scene::ParticleSet& set, std::size_t per_cell);

  [[nodiscard]] double edge() const { return edge_; }
  [[nodiscard]] std::uint32_t cells() const { return counts_[0] * counts_[1] * counts_[2]; }
  [[nodiscard]] std::uint32_t cell_of(const std::array<float, 4>& sphere) const;

 private:
  glm::dvec3 lo_{};
  double edge_ = 1;
  std::array<std::uint32_t, 3> counts_{1, 1, 1};
};

// Divides space according to the particles in it. It starts with the cells of a grid. Then it
// repeatedly divides a cell in two if its particles are distributed so unevenly that the division
// saves work. For example, it separates a wall from the particles behind it. The undivided cells
// and the results of these divisions are called parts.
//
// The cost of a box with n particles is n times the probability that it is visible, which is
// proportional to its surface area (the surface area heuristic of MacDonald and Booth, Heuristics
// for ray tracing using space subdivision, 1990). Let A be the surface area of the box around the
// spheres of a part with n particles. A plane divides the part into two parts with n₁ and n₂
// particles, whose boxes have the surface areas A₁ and A₂. The plane is used if the saving
// n·A − n₁·A₁ − n₂·A₂ is at least A times half the intended number of particles per cell. For
// example, if a plane halves a cube with evenly distributed particles, then n₁ = n₂ = n/2 and
// A₁ = A₂ = ⅔·A. This plane saves n·A/3, so the cube is divided only if n is at least one and a
// half times the intended number.
class Division {
 public:
  // Divides space for this scene. The constructor temporarily needs four bytes per particle.
  Division(const scene::ParticleScene& scene, std::size_t per_cell);

  // Returns the part that contains the particle with this index in the set. Part 0 contains the
  // particles that are wider than a cell of the grid. Particles with the same centre are in the
  // same part, unless some of them are large enough for part 0.
  [[nodiscard]] std::uint32_t part_of(std::uint32_t place) const;
  // Returns the number of parts, including empty parts.
  [[nodiscard]] std::size_t parts() const { return nodes_.size(); }

 private:
  // A node is a region of space. It is either a part or divided in two by a plane. The position of
  // a particle's centre relative to the plane determines the side to which the particle belongs.
  // Node 0 is part 0, and the nodes of the grid's cells come next.
  struct Node {
    static constexpr std::uint32_t whole = 3;
    std::uint32_t axis = whole;
    float plane = 0;
    std::uint32_t below = 0;  // node of the lower side; the next node is the upper side
  };
  struct PendingPart {
    std::uint32_t node = 0;
    std::span<std::uint32_t> places;
  };

  [[nodiscard]] std::uint32_t undivided_part_of(std::uint32_t place) const;
  void divide(PendingPart all);

  const scene::ParticleScene& scene_;
  Grid grid_;
  // A part is divided only if this saves at least `least_saving_` times the surface area of its
  // box.
  double least_saving_;
  std::vector<Node> nodes_;
};

}  // namespace triptych::technique
