// Tests that the error bound holds for images drawn with known arithmetic.

#include "suites/volume/tolerance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/half.hpp"
#include "unit/reference/float_renderer.hpp"
#include "unit/reference/random_scene.hpp"

namespace triptych::volume_suite {
namespace {

// Returns a scene with a flat box. If the eye is just above the box, the farthest point at which a
// ray can enter is at the far edge.
scene::VolumeScene plate(const glm::dvec3& eye) {
  scene::VolumeScene scene =
      reference::random_scene(5, reference::Character::rough, scene::VoxelFormat::f32);
  scene.grid = reference::make_grid({64, 4, 64}, {1, 1, 1}, scene::VoxelFormat::f32,
                                    [](int i, int j, int k) { return (i + j + k) % 3 / 2.0; });
  scene.camera = reference::look_at(eye, {32, 2, 33});
  return scene;
}

TEST(Tolerance, CoversTheDistanceToTheFarthestEntry) {
  const double inside = 7 * std::hypot(64, 4, 64);
  const auto expect = [&](const glm::dvec3& eye, double corner, double entry) {
    EXPECT_NEAR(error_model(plate(eye), {}).position_error_voxels,
                0x1.0p-24 * (glm::length(eye) + 20 * corner + 7 * entry + inside), 1e-12);
  };
  expect({1, 5, 1}, std::hypot(63, 5, 63), std::hypot(63, 1, 63));
  expect({1, 3, 1}, std::hypot(63, 3, 63), 0);
  // From outside an edge, the eye sees two faces, and the farthest corner is on the larger face.
  expect({-10, 5, 1}, std::hypot(74, 5, 63), std::hypot(74, 1, 63));
}

TEST(Tolerance, HoldsForSinglePrecision) {
  double largest = 0;
  const auto judge = [&](const scene::VolumeScene& scene) {
    const core::Image image = reference::render_float(scene, {});
    const reference::Truth truth = reference::render_volume(scene, error_model(scene, {}));
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
      const double bound = truth.bound[i / 4];
      const double error = std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]);
      EXPECT_LE(error, bound);
      if (bound > 0) largest = std::max(largest, error / bound);
    }
  };
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    scene::VolumeScene scene = reference::random_scene(
        seed, seed % 2 == 0 ? reference::Character::smooth : reference::Character::rough,
        scene::VoxelFormat::f32);
    scene.step_voxels = seed % 3 == 0 ? 0.37 : 1.0;
    judge(scene);
  }
  for (const glm::dvec3& eye : {glm::dvec3{1, 5, 1}, {-40, 4.1, -30}, {32, 300, 32}}) {
    judge(plate(eye));
  }
  // Some error must come reasonably close to its bound, because the bound could otherwise be
  // arbitrarily large.
  EXPECT_GT(largest, 0.02);
}

// Compares images of rounded voxels with the reference images of the original voxels. The bound
// must include a term for this rounding; without it, the bound is exceeded.
TEST(Tolerance, CoversVoxelsRoundedToHalves) {
  double with_term = 0;
  double without_term = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto character =
        seed % 2 == 0 ? reference::Character::smooth : reference::Character::rough;
    scene::VolumeScene scene = reference::random_scene(seed, character, scene::VoxelFormat::f32);
    scene.shading.enabled = seed % 3 == 0;
    scene::VolumeScene rounded = scene;
    rounded.grid = reference::random_scene(seed, character, scene::VoxelFormat::f16).grid;
    const core::Image image = reference::render_float(rounded, {});
    const auto largest_share = [&](const PathPrecision& path) {
      const reference::Truth truth = reference::render_volume(scene, error_model(scene, path));
      double largest = 0;
      for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
        const double error = std::abs(static_cast<double>(image.rgba[i]) - truth.rgba[i]);
        if (error > 0) largest = std::max(largest, error / truth.bound[i / 4]);
      }
      return largest;
    };
    with_term =
        std::max(with_term,
                 largest_share({.storage_step = 0x1p-28, .voxel_rounding = scene::half_roundoff}));
    without_term = std::max(without_term, largest_share({}));
  }
  EXPECT_LE(with_term, 1);
  EXPECT_GT(with_term, 0.02);
  EXPECT_GT(without_term, 1);
}

}  // namespace
}  // namespace triptych::volume_suite
