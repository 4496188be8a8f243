#include "scene/particle_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace triptych::scene {

double depth_scale(const Box& box, const glm::dvec3& eye) {
  const glm::dvec3 outside = eye - glm::clamp(eye, box.lo, box.hi);
  const double extent = glm::length(box.hi - box.lo) + glm::length(outside);
  // This is 2⁻²⁴ times the largest power of two that does not exceed the extent, or 0 if there is
  // no extent.
  return extent > 0 ? std::ldexp(1.0, std::ilogb(extent) - 24) : 0;
}

Camera particle_camera(std::string_view spec, const ParticleSet& set, double fov_y_deg) {
  const Box box = bounding_box(set);
  Camera camera = camera_at(spec, box, fov_y_deg);
  camera.near = depth_scale(box, camera.eye);
  return camera;
}

}  // namespace triptych::scene
