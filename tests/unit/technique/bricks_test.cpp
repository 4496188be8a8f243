#include "technique/volume/bricks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "scene/generators.hpp"

namespace triptych::technique {
namespace {

// Returns a transfer function that is opaque only within a random range of its table, or only
// outside of it. Empty bricks may therefore contain the lowest, the highest or intermediate values.
scene::TransferFunction stretch(core::Random& random) {
  scene::TransferFunction function;
  const std::size_t begin = random.bits() % 256;
  const std::size_t end = begin + 1 + random.bits() % 128;
  const bool opaque = random.bits() % 2 == 0;
  for (std::size_t k = 0; k < 256; ++k) {
    function.entries[k][3] = (begin <= k && k < end) == opaque ? 0.5F : 0.0F;
  }
  return function;
}

// Checks the range of values against every voxel of brick (x, y, z) and its border.
void expect_range(const scene::VoxelGrid& grid, const BrickLayout& layout, std::array<int, 3> brick,
                  float minimum, float maximum) {
  float lo = std::numeric_limits<float>::infinity();
  float hi = -lo;
  std::size_t index = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i, ++index) {
        const std::array<int, 3> at{i, j, k};
        bool within = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int begin = brick[axis] * layout.edge - layout.border;
          const int end =
              (brick[axis] + 1) * layout.edge + layout.border + (layout.is_cell_aligned ? 1 : 0);
          within = within && begin <= at[axis] && at[axis] < end;
        }
        const auto value = static_cast<float>(grid.normalised(index));
        if (!within || std::isnan(value)) continue;
        lo = std::min(lo, value);
        hi = std::max(hi, value);
      }
    }
  }
  ASSERT_EQ(minimum, lo);
  ASSERT_EQ(maximum, hi);
}

TEST(Bricks, RangesAreThoseOfTheirVoxels) {
  for (const std::array<int, 3> size : {std::array{1, 1, 1}, {1, 7, 2}, {13, 9, 11}}) {
    scene::VoxelGrid grid =
        scene::encode(scene::generate_volume("frequency_box", size), scene::VoxelFormat::u8);
    for (const int border : {0, 1, 3, 40}) {
      for (const BrickLayout& layout :
           {BrickLayout{.edge = 2, .border = border, .is_cell_aligned = true},
            BrickLayout{.edge = 4, .border = border}}) {
        const BrickRanges ranges = brick_ranges(grid, layout);
        std::size_t b = 0;
        for (int z = 0; z < ranges.counts[2]; ++z) {
          for (int y = 0; y < ranges.counts[1]; ++y) {
            for (int x = 0; x < ranges.counts[0]; ++x, ++b) {
              expect_range(grid, layout, {x, y, z}, ranges.minimum.at(b), ranges.maximum.at(b));
            }
          }
        }
        ASSERT_EQ(ranges.minimum.size(), b);
      }
    }
  }
}

TEST(Bricks, AnyIsEmptyAgreesWithTheVisibilityOfAll) {
  core::Random random(11);
  int with_empty = 0;
  constexpr int trials = 400;
  const auto grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("gaussian_blob", {24, 24, 24}), scene::VoxelFormat::u8));
  for (int trial = 0; trial < trials; ++trial) {
    const scene::VolumeScene scene{.grid = grid, .transfer_function = stretch(random)};
    for (const Skip skip : {Skip::bricks, Skip::distance}) {
      const BrickLayout layout = brick_layout(scene, skip);
      const auto visible = brick_visibility(brick_ranges(*grid, layout), scene.transfer_function);
      const bool empty = std::ranges::find(visible, 0U) != visible.end();
      ASSERT_EQ(any_brick_is_empty(scene, layout), empty) << trial;
      with_empty += empty ? 1 : 0;
    }
  }
  // Both cases, with and without an empty brick, must have occurred often enough.
  EXPECT_GT(with_empty, trials / 10);
  EXPECT_LT(with_empty, 2 * trials - trials / 10);
}

}  // namespace
}  // namespace triptych::technique
