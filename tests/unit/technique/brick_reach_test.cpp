// Compares the distances that rays may leap over bricks of one kind (visible or empty) with a
// search through every brick.

#include "technique/volume/brick_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/random.hpp"
#include "scene/generators.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/bricks.hpp"

namespace triptych::technique {
namespace {

// Returns the distance to the nearest brick of the other kind (visible or empty), found by testing
// all bricks.
int distance_to_other_kind(const std::array<int, 3>& counts,
                           const std::vector<std::uint32_t>& visible,
                           const std::array<int, 3>& at) {
  const auto index = [&](int x, int y, int z) {
    return static_cast<std::size_t>(x + counts[0] * (y + counts[1] * z));
  };
  int nearest = std::ranges::max(counts);
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x) {
        if (visible[index(x, y, z)] == visible[index(at[0], at[1], at[2])]) continue;
        nearest = std::min(
            nearest, std::max({std::abs(x - at[0]), std::abs(y - at[1]), std::abs(z - at[2])}));
      }
    }
  }
  return nearest;
}

TEST(BrickReach, IsTheDistanceToTheNearestBrickOfTheOtherKind) {
  core::Random random(3);
  for (const double share : {0.0, 0.02, 0.5, 0.97, 1.0}) {
    for (const std::array<int, 3>& counts : {std::array<int, 3>{7, 5, 9}, {1, 1, 1}, {12, 1, 3}}) {
      std::vector<std::uint32_t> visible(
          static_cast<std::size_t>(counts[0] * counts[1] * counts[2]));
      for (auto& each : visible) each = random.uniform(0, 1) < share ? 1 : 0;
      const auto reach = brick_reach(counts, visible);
      std::size_t b = 0;
      for (int z = 0; z < counts[2]; ++z) {
        for (int y = 0; y < counts[1]; ++y) {
          for (int x = 0; x < counts[0]; ++x, ++b) {
            ASSERT_EQ(std::abs(reach[b]), distance_to_other_kind(counts, visible, {x, y, z}));
            ASSERT_EQ(reach[b] > 0, visible[b] == 1);
          }
        }
      }
    }
  }
}

TEST(BrickLayout, CoversEverythingThatASampleMayRead) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("uniform_box", {40, 40, 40}), scene::VoxelFormat::u8));
  EXPECT_EQ(brick_layout(scene, Skip::bricks), (BrickLayout{.edge = 8, .border = 1}));
  EXPECT_EQ(brick_layout(scene, Skip::distance),
            (BrickLayout{.edge = 2, .border = 0, .is_cell_aligned = true}));
  scene.quadrature = scene::Quadrature::preintegrated;
  // With a step of ¼ voxel, a sample reads up to ½ + ⅛ voxel beyond a face of its brick (for the
  // interpolation and for half a step), plus round-off.
  scene.step_voxels = 0.25;
  EXPECT_EQ(brick_layout(scene, Skip::bricks).border, 1);
  EXPECT_EQ(brick_layout(scene, Skip::distance).border, 1);
  scene.step_voxels = 1;
  EXPECT_EQ(brick_layout(scene, Skip::bricks).border, 2);
  EXPECT_EQ(brick_layout(scene, Skip::distance).border, 1);
  scene.step_voxels = 1e6;
  EXPECT_GE(brick_layout(scene, Skip::bricks).border, 40);
}

TEST(BrickLayout, ALargeVolumeHasLargerBricksOfCells) {
  scene::VolumeScene scene;
  scene::VoxelGrid grid;
  const auto edge = [&](std::array<int, 3> size) {
    grid.size = size;
    scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
    return brick_layout(scene, Skip::distance).edge;
  };
  // With an edge of 2 cells, this volume has 2²⁵ bricks. Their map has 2²⁷ bytes, which is the
  // largest size that is allowed.
  EXPECT_EQ(edge({513, 513, 1025}), 2);
  EXPECT_EQ(edge({513, 513, 1026}), 4);
  EXPECT_EQ(edge({16384, 16384, 16384}), 64);
}

TEST(BrickMap, IsVisibilityOrReach) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("sparse_field", {40, 33, 21}), scene::VoxelFormat::u8));
  scene.transfer_function = scene::load_transfer_function("haze");
  EXPECT_EQ(brick_map(scene, Skip::none).size(), 1);
  const auto visible = brick_map(scene, Skip::bricks);
  EXPECT_EQ(visible.size(), 5U * 5U * 3U);
  EXPECT_TRUE(std::ranges::any_of(visible, [](int v) { return v == 1; }));
  EXPECT_TRUE(std::ranges::any_of(visible, [](int v) { return v == 0; }));
  const auto reach = brick_map(scene, Skip::distance);
  EXPECT_EQ(reach.size(), 20U * 16U * 10U);
  EXPECT_TRUE(std::ranges::any_of(reach, [](int r) { return r < -1; }));
}

}  // namespace
}  // namespace triptych::technique
