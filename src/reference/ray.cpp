#include "reference/ray.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace triptych::reference {

double Ray::slack() const {
  return std::max(longest - length, length - shortest);
}

glm::dvec3 Ray::position_error_within(double distance) const {
  return position_error + distance * glm::abs(voxels_per_unit);
}

RayMaker::RayMaker(const scene::VolumeScene& scene, double position_error_voxels)
    : scene_(&scene),
      spacing_(scene.grid->spacing[0], scene.grid->spacing[1], scene.grid->spacing[2]),
      size_(scene.grid->size[0], scene.grid->size[1], scene.grid->size[2]),
      eye_((scene.camera.eye - scene.box().lo) / spacing_),
      position_error_(position_error_voxels) {}

std::optional<RayMaker::Chord> RayMaker::clip(const glm::dvec3& voxels_per_unit,
                                              double margin) const {
  Chord chord{0.0, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = eye_[axis];
    const double speed = voxels_per_unit[axis];
    const double lo = -margin;
    const double hi = size_[axis] + margin;
    if (speed == 0.0) {
      if (origin < lo || origin > hi) return std::nullopt;
      continue;
    }
    double near = (lo - origin) / speed;
    double far = (hi - origin) / speed;
    if (near > far) std::swap(near, far);
    chord.begin = std::max(chord.begin, near);
    chord.end = std::min(chord.end, far);
  }
  if (!(chord.begin <= chord.end)) return std::nullopt;
  return chord;
}

std::optional<Ray> RayMaker::operator()(int x, int y) const {
  Ray ray;
  ray.direction = scene_->camera.ray_direction(x, y, scene_->width, scene_->height);
  ray.voxels_per_unit = ray.direction / spacing_;
  const std::optional<Chord> chord = clip(ray.voxels_per_unit, 0.0);
  if (position_error_ == 0.0) {
    if (!chord) return std::nullopt;
    ray.entry = eye_ + chord->begin * ray.voxels_per_unit;
    ray.length = ray.shortest = ray.longest = chord->end - chord->begin;
    return ray;
  }
  const std::optional<Chord> outer = clip(ray.voxels_per_unit, position_error_);
  if (!outer) return std::nullopt;
  const std::optional<Chord> inner = clip(ray.voxels_per_unit, -position_error_);
  const double begin = chord ? chord->begin : outer->begin;
  ray.entry = eye_ + begin * ray.voxels_per_unit;
  ray.length = chord ? chord->end - chord->begin : 0.0;
  ray.longest = outer->end - outer->begin;
  ray.shortest = inner ? inner->end - inner->begin : 0.0;
  const double latest = inner ? inner->begin : outer->end;
  const double entry_error = std::max(begin - outer->begin, latest - begin);
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = ray.voxels_per_unit[axis];
    ray.position_error[axis] = position_error_ + entry_error * (speed < 0.0 ? -speed : speed);
  }
  return ray;
}

void cut_at_planes(const Ray& ray, const std::array<int, 3>& size, std::vector<double>& at) {
  at.assign({0.0, ray.length});
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = ray.voxels_per_unit[axis];
    if (speed == 0.0) continue;
    const double a = ray.entry[axis];
    const double b = a + ray.length * speed;
    const int first = std::max(static_cast<int>(std::floor(std::min(a, b))), 0);
    const int last = std::min(static_cast<int>(std::ceil(std::max(a, b))),
                              size[static_cast<std::size_t>(axis)] - 1);
    for (int k = first; k <= last; ++k) {
      const double t = (k + 0.5 - a) / speed;
      if (t > 0.0 && t < ray.length) at.push_back(t);
    }
  }
  std::sort(at.begin(), at.end());
}

}  // namespace triptych::reference
