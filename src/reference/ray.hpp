#pragma once
// The ray of a pixel, clipped to the volume, and how far the error model lets its ends move.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::reference {

// Positions in voxels (voxel centres at i+½), lengths along the ray in world units.
struct Ray {
  glm::dvec3 direction{};        // unit, world
  glm::dvec3 voxels_per_unit{};  // direction / spacing
  glm::dvec3 entry{};            // where the ray enters the volume
  double length = 0;             // of the chord inside the volume; 0 where the ray misses it …
  double shortest = 0;           // … and the least
  double longest = 0;            // … and most that a device may find
  glm::dvec3 position_error{};   // of a sample's place per axis, the uncertain entry included

  // How much sooner or later a device may let it begin, and end.
  [[nodiscard]] double slack() const;
  // Of a place that may lie so far along the ray from where it is looked for.
  [[nodiscard]] glm::dvec3 position_error_within(double way) const;
};

// Distances from the entry at which the ray crosses planes of voxel centres of a grid of `size`,
// ascending, both ends of the chord included. In place of what `at` held.
void cut_at_planes(const Ray& ray, const std::array<int, 3>& size, std::vector<double>& at);

// The rays of one scene.
class RayMaker {
 public:
  // A device's ray runs within `position_error_voxels` per axis of the true one. So its chord lies
  // between those of the volume shrunk and grown by that much on every side, and all its samples
  // shift along the ray with its entry point: at grazing incidence by far more than the error
  // across it.
  RayMaker(const scene::VolumeScene& scene, double position_error_voxels);

  // Nothing where no device allowed by the model can hit the volume.
  [[nodiscard]] std::optional<Ray> operator()(int x, int y) const;

 private:
  struct Chord {
    double begin = 0;
    double end = 0;
  };
  // The part t ≥ 0 of the ray in the volume grown by `margin` voxels on every side. A direction
  // component of ±0 never divides: the ray lies in that slab for all t or for none.
  [[nodiscard]] std::optional<Chord> clip(const glm::dvec3& voxels_per_unit, double margin) const;

  const scene::VolumeScene* scene_;
  glm::dvec3 spacing_;
  glm::dvec3 size_;  // voxels
  glm::dvec3 eye_;   // voxels
  double position_error_;
};

}  // namespace triptych::reference
