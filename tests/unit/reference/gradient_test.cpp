// Compares the gradient that the reference renderer uses for shading with closed-form solutions:
// with a sine wave, for which the central difference at voxel centres is the derivative times a
// known factor (problem V9 in closed_forms.hpp), and with quadratic fields, for which central
// differences are exact everywhere.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/closed_forms.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {
namespace {

constexpr int voxels = 24;
// This gradient is steeper than that of any field below. The brightness of a white, opaque sample
// is the ratio of its gradient to this gradient.
constexpr double steeper = 0.25;

// Returns a scene with a cube of voxels that store value(z), where z is in voxels. The transfer
// function maps every value to opaque white.
scene::VolumeScene lit_scene(const std::function<double(double)>& value) {
  scene::Volume volume;
  volume.size = {voxels, voxels, voxels};
  volume.type = scene::ScalarType::f32;
  for (int at = 0; at < voxels * voxels * voxels; ++at) {
    const double z = at / (voxels * voxels) + 0.5;
    const auto bytes =
        std::bit_cast<std::array<std::byte, sizeof(float)>>(static_cast<float>(value(z)));
    volume.voxels.insert(volume.voxels.end(), bytes.begin(), bytes.end());
  }
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(std::move(volume), scene::VoxelFormat::f32));
  scene.transfer_function.entries.fill({1, 1, 1, 1});
  scene.width = scene.height = 1;
  scene.shading = {
      .enabled = true, .ambient = 0, .diffuse = 1, .specular = 0, .gradient_floor = steeper};
  return scene;
}

// Returns |gradient · direction| at the point p, where the gradient is the change of the value per
// voxel length. Puts the eye half a step behind p, so that the first sample of the ray is at p.
double steepness_at(scene::VolumeScene scene, const glm::dvec3& p, const glm::dvec3& direction) {
  scene.camera.eye = p - 0.5 * scene.step_voxels * direction;
  scene.camera.forward = direction;
  scene.camera.up = {0, 1, 0};
  return render_volume(scene).rgba[0] * steeper;
}

// Bounds the round-off of a central difference, which is half the difference between two values
// stored as floats. `largest` is the largest magnitude of a value.
double rounding_of(double largest) {
  return 0x1.0p-24 * largest;
}

TEST(Gradient, OfASineIsTheDerivativeTimesV9sFactor) {
  for (const double k : {0.1, 0.4, 1.0}) {
    const double amplitude = 0.2;
    const scene::VolumeScene scene =
        lit_scene([&](double z) { return 0.5 + amplitude * std::sin(k * z); });
    for (const int layer : {2, 7, 11, 20}) {
      const double z = layer + 0.5;
      const double derivative = amplitude * k * std::cos(k * z);
      EXPECT_NEAR(steepness_at(scene, {9.2, 12.7, z}, {0, 0, 1}),
                  std::abs(derivative * v9_difference_factor(k, 1.0)), rounding_of(0.7))
          << k << ' ' << layer;
    }
  }
}

// If the voxels are half as large relative to the wave, the error is a quarter.
TEST(Gradient, IsOfSecondOrderInTheVoxelSize) {
  std::vector<double> errors;
  for (const double k : {0.4, 0.2, 0.1}) {
    const scene::VolumeScene scene =
        lit_scene([&](double z) { return 0.5 + 0.2 * std::sin(k * (z - 8.5)); });
    const double steepness = steepness_at(scene, {9.2, 12.7, 8.5}, {0, 0, 1});
    errors.push_back(std::abs(steepness / (0.2 * k) - 1.0));
  }
  EXPECT_GE(std::log2(errors[0] / errors[1]), 1.95);
  EXPECT_GE(std::log2(errors[1] / errors[2]), 1.95);
}

TEST(Gradient, OfAQuadraticIsExact) {
  const scene::VolumeScene scene =
      lit_scene([](double z) { return 0.05 + 0.004 * z + 0.001 * z * z; });
  const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.4, -0.3, 1.0));
  for (const double z : {1.5, 3.0, 8.13, 15.77, 22.4}) {
    EXPECT_NEAR(steepness_at(scene, {10.4, 13.9, z}, oblique), (0.004 + 0.002 * z) * oblique.z,
                rounding_of(0.75))
        << z;
  }
}

}  // namespace
}  // namespace triptych::reference
