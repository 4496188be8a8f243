#include "reference/sphere_tree.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace triptych::reference {

namespace {

constexpr std::uint32_t leaf_size = 4;

float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  if (static_cast<double>(rounded) <= value) return rounded;
  return std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

}  // namespace

SphereTree::SphereTree(const scene::ParticleScene& scene, double growth)
    : eye_(scene.camera.eye), growth_(growth) {
  const scene::ParticleSet& set = *scene.particles;
  spheres_.reserve(set.count());
  for (std::size_t i = 0; i < set.count(); ++i) {
    const auto& [x, y, z, unscaled] = set.spheres[i];
    const float radius = scene.radius(i);
    if (!std::isfinite(radius)) {
      throw core::InputError(
          fmt::format("the product of radius {} and radius_scale {} is not finite", unscaled,
                      scene.radius_scale));
    }
    if (radius > 0) spheres_.push_back({{x, y, z}, radius, static_cast<std::uint32_t>(i)});
  }
  if (spheres_.empty()) return;
  // A leaf has at least two spheres, unless it is the root, so nodes do not outnumber spheres.
  nodes_.reserve(spheres_.size());
  build(0, static_cast<std::uint32_t>(spheres_.size()));
}

void SphereTree::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t own = nodes_.size();
  nodes_.push_back(enclose(first, last));
  if (last - first <= leaf_size) {
    nodes_[own].next = first;
    nodes_[own].count = last - first;
    return;
  }
  glm::vec3 lo = spheres_[first].centre;
  glm::vec3 hi = lo;
  for (std::uint32_t i = first; i < last; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], spheres_[i].centre[axis]);
      hi[axis] = std::max(hi[axis], spheres_[i].centre[axis]);
    }
  }
  // Both bounds are halved before the subtraction, because the difference of two finite floats may
  // exceed the largest float.
  const glm::vec3 width = 0.5F * hi - 0.5F * lo;
  int widest = width.y > width.x ? 1 : 0;
  if (width.z > width[widest]) widest = 2;
  const std::uint32_t middle = first + (last - first) / 2;
  const auto begin = spheres_.begin();
  std::nth_element(
      begin + first, begin + middle, begin + last,
      [widest](const Sphere& a, const Sphere& b) { return a.centre[widest] < b.centre[widest]; });
  build(first, middle);
  nodes_[own].next = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

SphereTree::Node SphereTree::enclose(std::uint32_t first, std::uint32_t last) {
  glm::dvec3 lo(std::numeric_limits<double>::infinity());
  glm::dvec3 hi = -lo;
  for (std::uint32_t i = first; i < last; ++i) {
    const glm::dvec3 centre = glm::dvec3(spheres_[i].centre) - eye_;
    const double radius = spheres_[i].radius;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], centre[axis] - radius);
      hi[axis] = std::max(hi[axis], centre[axis] + radius);
    }
  }
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double corner = std::max(-lo[axis], hi[axis]);
    squared += corner * corner;
  }
  const double corner = std::sqrt(squared);
  farthest_ = std::max(farthest_, corner);
  Node node;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto component = static_cast<glm::length_t>(axis);
    node.lo[axis] = rounded_down(lo[component] - growth_ * corner);
    node.hi[axis] = -rounded_down(-(hi[component] + growth_ * corner));
  }
  return node;
}

}  // namespace triptych::reference
