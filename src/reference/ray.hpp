#pragma once
// The ray of a pixel, clipped to the volume, and the possible displacement of its ends on a device.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/volume_scene.hpp"

namespace triptych::reference {

// Positions are in voxels (voxel centres are at i+½), and lengths along the ray are in world units.
struct Ray {
  glm::dvec3 direction{};        // unit vector in world space
  glm::dvec3 voxels_per_unit{};  // direction / spacing
  glm::dvec3 entry{};            // entry point into the volume
  double length = 0;             // length of the chord inside the volume; 0 if the ray misses it
  double shortest = 0;           // length of the shortest chord on any device
  double longest = 0;            // length of the longest chord on any device
  glm::dvec3 position_error{};   // for a sample, per axis; includes the error of the entry point

  // Returns the largest distance by which the ray may begin or end earlier or later on a device.
  [[nodiscard]] double slack() const;
  // Returns the position error of a point that may be displaced along the ray by up to `distance`.
  [[nodiscard]] glm::dvec3 position_error_within(double distance) const;
};

// Sets `at` to the distances from the entry at which the ray crosses the planes of voxel centres of
// a grid of `size`, and to both ends of the chord, in ascending order.
void cut_at_planes(const Ray& ray, const std::array<int, 3>& size, std::vector<double>& at);

// Creates the rays of one scene.
class RayMaker {
 public:
  // On a device, a ray runs within `position_error_voxels` per axis of the exact ray. Its chord is
  // therefore at least as long as in a volume that is shrunk by this distance on every side, and at
  // most as long as in a volume that is grown by it. All samples shift along the ray with the entry
  // point. At grazing incidence, this shift is far larger than the error across the ray.
  RayMaker(const scene::VolumeScene& scene, double position_error_voxels);

  // Returns nullopt if the ray misses the volume on every device whose rays are within the position
  // error that was passed to the constructor.
  [[nodiscard]] std::optional<Ray> operator()(int x, int y) const;

 private:
  struct Chord {
    double begin = 0;
    double end = 0;
  };
  // Returns the part of the ray with t ≥ 0 that is inside the volume grown by `margin` voxels on
  // every side. It never divides by a direction component of ±0, because such a ray is between the
  // two planes for all t or for none.
  [[nodiscard]] std::optional<Chord> clip(const glm::dvec3& voxels_per_unit, double margin) const;

  const scene::VolumeScene* scene_;
  glm::dvec3 spacing_;
  glm::dvec3 size_;  // in voxels
  glm::dvec3 eye_;   // in voxels
  double position_error_;
};

}  // namespace triptych::reference
