// Stress cases 8 to 13 of the catalogue in docs/accuracy.md, which test the size and the spacing of
// volumes.

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "suites/volume/stress_parts.hpp"
#include "suites/volume/stress_scenes.hpp"

namespace triptych::volume_suite {

// Scales the voxel size by a power of two. Opacity is defined per voxel length, so the extinction
// per world unit scales inversely and the image stays the same.
StressScene stress_scale(std::string_view variant) {
  StressScene scene = asymmetric_scene();
  if (variant == "one") return scene;
  const double scale = variant == "up" ? 0x1.0p20 : 0x1.0p-20;
  scene.volume.spacing = {scale, scale, scale};
  scene.camera.eye *= scale;
  scene.expectations = {same_bits_as(
      "stress:scale:one",
      "an image that is bit-identical to the image with scale 1, because multiplying by a power of "
      "two causes no rounding")};
  return scene;
}

StressScene stress_spacing(std::string_view variant) {
  const bool extreme = variant == "1000";
  scene::Volume volume = asymmetric_volume({20, 18, extreme ? 6 : 12});
  volume.spacing = {1, 1, extreme ? 1000.0 : 8.0};
  StressScene scene = seen_from_outside(std::move(volume));
  if (extreme) {
    // The camera is in front of the long side, where each ray crosses only a part of one layer of
    // voxels, which is 1,000 units thick.
    scene.camera = camera_looking_at({70, 35, 3010}, {10, 9, 3000}, 40);
  }
  return scene;
}

StressScene stress_slice(std::string_view variant) {
  const Size size{variant == "x" ? 1 : 24, variant == "y" ? 1 : 24, variant == "z" ? 1 : 24};
  StressScene scene = seen_from_outside(asymmetric_volume(size));
  scene.function = ramp(20, 0.9);
  scene.step_voxels = 0.125;
  return scene;
}

StressScene stress_tiny(std::string_view variant) {
  const int n = variant == "1" ? 1 : 2;
  StressScene scene = seen_from_outside(
      volume_of({n, n, n}, [](int i, int j, int k) { return 0.9 - 0.4 * i - 0.2 * j - 0.1 * k; }));
  scene.function = ramp(20, 0.9);
  scene.step_voxels = 0.125;
  return scene;
}

StressScene stress_prime(std::string_view /*variant*/) {
  return seen_from_outside(asymmetric_volume({13, 31, 17}));
}

StressScene stress_oversize(std::string_view /*variant*/) {
  StressScene scene = seen_from_outside(asymmetric_volume({20000, 1, 1}));
  scene.camera = camera_looking_at({12000, 7, 11}, {11990, 0.5, 0.5}, 60);
  scene.expectations = {
      {"an image, or an error that names the exceeded limit", record::MayBeRefused{}}};
  return scene;
}

}  // namespace triptych::volume_suite
