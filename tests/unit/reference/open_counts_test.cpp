// Open counts are the part of a raycaster's counts that round-off may change. They must cover
// arithmetic that rounds differently, but must not be large enough to hide a fault.

#include "reference/open_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "float_renderer.hpp"
#include "random_scene.hpp"

namespace triptych::reference {
namespace {

scene::VolumeScene volume_seen_by(scene::Camera camera, double size = 1, int voxels = 24) {
  const auto value = [](int x, int y, int z) { return (x + y + z) % 7 < 3 ? 0.0 : 0.1 * (x % 5); };
  scene::TransferFunction table = constant_table({1, 1, 1, 0.125F});
  table.entries[0][3] = 0;
  camera.eye *= size;
  return {.grid = make_grid({voxels, voxels, voxels}, {size, size, size}, scene::VoxelFormat::f32,
                            value),
          .transfer_function = table,
          .camera = camera,
          // With an odd width, one column of rays points exactly in the direction of the camera.
          .width = 65,
          .height = 49,
          .step_voxels = 0.5};
}

scene::Camera oblique() {
  return look_at({-9.1, 30.3, -17.7}, {12.3, 11.9, 12.2});
}
// Some rays lie within the face x = 0, and some others cross two cell edges at a time.
scene::Camera within_a_face() {
  return look_at({0, 11, 40}, {0, 11, 0});
}
scene::Camera straight() {
  return look_at({12, 12, 60}, {12, 12, 0});
}
scene::Camera diagonal() {
  return look_at({-20, 12, -20}, {12, 12, 12});
}

// If the same scene is expressed in another unit of length, it is drawn with different round-off.
TEST(OpenCounts, CoverArithmeticThatRoundsDifferently) {
  const FloatOptions options;
  double largest = 0;
  for (const scene::Camera& camera : {oblique(), within_a_face(), diagonal(), straight()}) {
    const scene::VolumeScene scene = volume_seen_by(camera);
    const auto open = open_counts(scene, float_model(scene, options), {});
    const FloatCounts plain = count_float(scene, options);
    for (const double size : {3.0, 0.7, 1.0 / 3, 1e-3, 1234.5}) {
      const FloatCounts other = count_float(volume_seen_by(camera, size), options);
      EXPECT_LE(std::abs(other.hits - plain.hits), open.at("rays_hit")) << size;
      EXPECT_LE(std::abs(other.samples - plain.samples), open.at("samples")) << size;
      EXPECT_LE(std::abs(other.nonzero - plain.nonzero), open.at("samples_nonzero")) << size;
      largest = std::max(largest, std::abs(other.samples - plain.samples));
    }
  }
  EXPECT_GT(largest, 0) << "rounding did not change any count";
}

// One additional sample in a tenth of the rays must exceed the open counts.
TEST(OpenCounts, AreFewInAGeneralPosition) {
  const scene::VolumeScene scene = volume_seen_by(oblique());
  const FloatOptions options;
  const FloatCounts counts = count_float(scene, options);
  for (const BrickPlanes planes : {BrickPlanes{}, BrickPlanes{8, 0}, BrickPlanes{2, 0.5}}) {
    const auto open = open_counts(scene, float_model(scene, options), planes);
    EXPECT_LE(open.at("rays_hit"), 0.002 * counts.hits) << planes.edge;
    EXPECT_LE(open.at("samples"), 0.1 * counts.hits) << planes.edge;
    EXPECT_LE(open.at("bricks_visited"), 0.1 * counts.hits) << planes.edge;
  }
}

TEST(OpenCounts, AreWholeRaysWithinAFace) {
  const scene::VolumeScene face = volume_seen_by(within_a_face());
  const FloatOptions options;
  const auto open = open_counts(face, float_model(face, options), {8, 0});
  EXPECT_GE(open.at("rays_hit"), 1);
  EXPECT_GT(open.at("samples"), 20 * open.at("rays_hit"));
  EXPECT_GT(open.at("bricks_visited"), open.at("rays_hit"));
}

// Without round-off, no count is open.
TEST(OpenCounts, AreZeroForExactArithmetic) {
  for (const scene::Quadrature quadrature :
       {scene::Quadrature::midpoint, scene::Quadrature::cells}) {
    scene::VolumeScene scene = volume_seen_by(oblique());
    scene.quadrature = quadrature;
    for (const auto& [name, count] : open_counts(scene, {}, {8, 0})) {
      EXPECT_EQ(name == "samples_nonzero" ? 0 : count, 0) << name;
    }
  }
}

TEST(OpenCounts, OfCellsAreThePiecesThatEndTogether) {
  const FloatOptions options;
  scene::VolumeScene scene = volume_seen_by(diagonal());
  scene.grid = make_grid({24, 24, 24}, {1, 1, 1}, scene::VoxelFormat::f32,
                         [](int x, int y, int z) { return 0.2 + (x + 2 * y + 3 * z) / 300.0; });
  scene.quadrature = scene::Quadrature::cells;
  const double ties = open_counts(scene, float_model(scene, options), {}).at("samples");
  scene.camera = oblique();
  EXPECT_GT(ties, 5 * open_counts(scene, float_model(scene, options), {}).at("samples"));
}

}  // namespace
}  // namespace triptych::reference
