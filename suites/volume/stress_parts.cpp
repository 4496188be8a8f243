#include "suites/volume/stress_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <utility>

namespace triptych::volume_suite {
namespace {

// Returns (1 − t²)² inside the ball t < 1, where t is the distance from `centre` divided by
// `radius`, and 0 outside.
double blob(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  const glm::dvec3 d = (p - centre) / radius;
  const double inside = 1 - (d.x * d.x + d.y * d.y + d.z * d.z);
  return inside > 0 ? inside * inside : 0;
}

glm::dvec3 extent_of(const scene::Volume& volume) {
  return {volume.size[0] * volume.spacing[0], volume.size[1] * volume.spacing[1],
          volume.size[2] * volume.spacing[2]};
}

}  // namespace

scene::Volume volume_of(const Size& size, const Voxel& voxel) {
  scene::Volume volume;
  volume.size = size;
  volume.type = scene::ScalarType::f32;
  volume.voxels.resize(volume.voxel_count() * sizeof(float));
  std::byte* out = volume.voxels.data();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const auto value = static_cast<float>(voxel(i, j, k));
        std::memcpy(out, &value, sizeof value);
        out += sizeof value;
      }
    }
  }
  return volume;
}

double asymmetric_value(const Size& size, int i, int j, int k) {
  const glm::dvec3 p{(i + 0.5) / size[0], (j + 0.5) / size[1], (k + 0.5) / size[2]};
  const double value =
      0.95 * blob(p, {0.31, 0.64, 0.42}, 0.42) + 0.6 * blob(p, {0.75, 0.27, 0.7}, 0.3);
  return std::min(value, 0.95);
}

scene::Volume asymmetric_volume(const Size& size) {
  return volume_of(size, [&](int i, int j, int k) { return asymmetric_value(size, i, j, k); });
}

scene::TransferFunction uniform(const std::array<float, 4>& rgba) {
  scene::TransferFunction function;
  function.entries.fill(rgba);
  return function;
}

scene::TransferFunction ramp(int first, double most) {
  scene::TransferFunction function;
  for (int entry = 0; entry < 256; ++entry) {
    const double turn = entry / 255.0;
    const double rise = std::max(0, entry - first) / static_cast<double>(255 - first);
    function.entries[static_cast<std::size_t>(entry)] = {
        static_cast<float>(0.125 + 0.875 * turn), static_cast<float>(0.25 + 0.25 * turn),
        static_cast<float>(1 - 0.875 * turn), static_cast<float>(most * rise)};
  }
  return function;
}

scene::Camera along(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                    double fov_y_deg) {
  scene::Camera camera;
  camera.eye = eye;
  camera.forward = forward;
  camera.up = up;
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

scene::Camera from_outside(const scene::Volume& volume) {
  const glm::dvec3 extent = extent_of(volume);
  const glm::dvec3 centre = extent * 0.5;
  return camera_looking_at(centre + glm::length(extent) * glm::dvec3(0.75, 0.5, 1), centre, 50);
}

StressScene seen_from_outside(scene::Volume volume) {
  StressScene scene;
  scene.camera = from_outside(volume);
  scene.volume = std::move(volume);
  scene.function = ramp(20, 0.4);
  return scene;
}

StressScene asymmetric_scene() {
  return seen_from_outside(asymmetric_volume({24, 24, 24}));
}

record::Expectation same_bits_as(const std::string& data, std::string what) {
  return {std::move(what), record::SameImage{.changed = {{"data", data}}}};
}

record::Expectation same_within_bounds_as(const std::string& data, std::string what) {
  return {std::move(what), record::SameImage{.changed = {{"data", data}}, .bit_identical = false}};
}

}  // namespace triptych::volume_suite
