#pragma once
// A tree of boxes around spheres, built for one position of the eye. It finds the spheres that a
// ray may come near.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "scene/particle_scene.hpp"

namespace triptych::reference {

// Nodes are split at the median centre along the widest axis, so that neither clusters nor a giant
// sphere among small spheres makes the tree deeper than ⌈log₂(count/4)⌉ levels. The tree needs at
// most 52 bytes per sphere.
class SphereTree {
 public:
  struct Sphere {
    glm::vec3 centre{};       // in world space
    float radius = 0;         // with radius_scale
    std::uint32_t index = 0;  // index in the particle set
  };

  // Every box is grown by `growth` times the distance of its farthest corner from the eye. Throws
  // InputError if a scaled radius is not finite. Spheres whose scaled radius underflows to 0 are
  // left out.
  SphereTree(const scene::ParticleScene& scene, double growth);

  // Returns the distance from the eye to the farthest corner of any box around spheres.
  [[nodiscard]] double farthest() const { return farthest_; }
  [[nodiscard]] const Sphere& sphere(std::uint32_t place) const { return spheres_[place]; }

  // Calls visit(place) for every sphere whose grown box the ray hits at some t with 0 ≤ t ≤
  // limit(), and possibly for further spheres, in the order of the distances to their boxes.
  // limit() may decrease between calls. `direction` is a unit vector.
  template <typename Limit, typename Visit>
  void walk(const glm::dvec3& direction, const Limit& limit, const Visit& visit) const {
    if (nodes_.empty()) return;
    const glm::dvec3 inverse = inverse_of(direction);
    std::array<Pending, 64> stack;  // each of fewer than 32 levels pushes one entry
    std::size_t size = 0;
    Pending at{0, entry(nodes_[0], inverse)};
    for (;;) {
      if (at.entry <= limit()) {
        const Node& node = nodes_[at.node];
        if (node.count == 0) {
          Pending near{at.node + 1, entry(nodes_[at.node + 1], inverse)};
          Pending far{node.next, entry(nodes_[node.next], inverse)};
          if (far.entry < near.entry) std::swap(near, far);
          if (far.entry < missed) stack[size++] = far;
          at = near;
          continue;
        }
        if (at.entry < missed) {
          for (std::uint32_t i = 0; i < node.count; ++i) visit(node.next + i);
        }
      }
      if (size == 0) return;
      at = stack[--size];
    }
  }

 private:
  // The first child of a node directly follows it.
  struct Node {
    std::array<float, 3> lo{};  // lower corner, relative to the eye
    std::array<float, 3> hi{};
    std::uint32_t next = 0;   // index of the second child, or of a leaf's first sphere
    std::uint32_t count = 0;  // number of spheres in a leaf; 0 for an inner node
  };
  struct Pending {
    std::uint32_t node;
    double entry;
  };
  static constexpr double missed = std::numeric_limits<double>::infinity();

  // A component of ±0 is replaced by a tiny number, so that the ray stays between the two planes
  // and 0·∞ does not occur.
  static glm::dvec3 inverse_of(const glm::dvec3& direction) {
    glm::dvec3 inverse;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = std::max(std::abs(direction[axis]), 1e-250);
      inverse[axis] = std::copysign(1 / size, direction[axis]);
    }
    return inverse;
  }

  static double entry(const Node& node, const glm::dvec3& inverse) {
    double near = 0;
    double far = std::numeric_limits<double>::max();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double speed = inverse[static_cast<glm::length_t>(axis)];
      const double a = static_cast<double>(node.lo[axis]) * speed;
      const double b = static_cast<double>(node.hi[axis]) * speed;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far ? near : missed;
  }

  void build(std::uint32_t first, std::uint32_t last);
  [[nodiscard]] Node enclose(std::uint32_t first, std::uint32_t last);

  glm::dvec3 eye_;
  double growth_;
  double farthest_ = 0;
  std::vector<Sphere> spheres_;  // in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace triptych::reference
