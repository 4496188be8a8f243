// Tests the shape of the hierarchy, the curve that orders it, and the boxes around spheres.

#include "technique/particles/hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/random.hpp"
#include "technique/portable/prelude.hpp"

namespace triptych::technique {
namespace {

using namespace portable;

TEST(Hierarchy, LeavesContainEveryParticleOnce) {
  for (const std::uint32_t count : {1U, 3U, 4U, 7U, 8U, 9U, 63U, 64U, 65U, 513U, 100000U}) {
    SCOPED_TRACE(count);
    const Hierarchy tree(count, {0, 0, 0}, 1);
    EXPECT_EQ(tree.leaf_begin(0), 0U);
    EXPECT_EQ(tree.leaf_begin(tree.leaves()), count);
    for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf) {
      const std::uint32_t size = tree.leaf_begin(leaf + 1) - tree.leaf_begin(leaf);
      EXPECT_LE(size, 8U);
      EXPECT_GE(size, count < 4 ? count : 4U);
    }
  }
}

TEST(Hierarchy, OfNoParticlesHasOneEmptyLeaf) {
  const Hierarchy tree(0, {0, 0, 0}, 0);
  EXPECT_EQ(tree.leaves(), 1U);
  EXPECT_EQ(tree.leaf_begin(1), 0U);
  EXPECT_GT(tree.sorted_words(), 0U);
}

TEST(Hierarchy, ASetWithoutExtentHasOnePositionOnTheCurve) {
  EXPECT_EQ(Hierarchy(10, {1, 2, 3}, 0).parameters().origin[3], 0.0F);
  EXPECT_EQ(Hierarchy(10, {1, 2, 3}, 1e-40F).parameters().origin[3], 0.0F);
}

TEST(Hierarchy, SortPassesEndInTheFirstList) {
  const Hierarchy tree(1000, {0, 0, 0}, 1);
  std::uint32_t from = 0;
  std::uint32_t shift = 0;
  for (const SortPass& pass : sort_passes(tree)) {
    EXPECT_EQ(pass.from, from);
    EXPECT_EQ(pass.shift, shift);
    from = tree.particles() - from;
    shift += 8;
  }
  EXPECT_EQ(from, 0U);
  EXPECT_GE(shift, 30U);
}

TEST(Hierarchy, GroupsCoverAllInvocations) {
  for (const std::uint32_t n : {1U, 64U, 65U, 4194240U, 4194241U, 40000000U}) {
    const auto [columns, rows] = group_rows(n);
    EXPECT_GE(std::uint64_t{64} * columns * rows, n);
    EXPECT_LE(columns, 65535U);
  }
}

// Consecutive cells on the curve must be neighbours, one step apart along one axis. The first 512
// cells must fill an 8×8×8 corner of the grid, each exactly once.
TEST(BoxMath, HilbertsCurveGoesFromNeighbourToNeighbour) {
  std::vector<std::array<int, 3>> at(512, {-1, -1, -1});
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) {
        const int place = tri_hilbert_place(x, y, z);
        ASSERT_GE(place, 0);
        ASSERT_LT(place, 512);
        EXPECT_EQ(at[static_cast<std::size_t>(place)][0], -1)
            << "place " << place << " was assigned twice";
        at[static_cast<std::size_t>(place)] = {x, y, z};
      }
    }
  }
  for (std::size_t i = 1; i < at.size(); ++i) {
    int steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) steps += std::abs(at[i][axis] - at[i - 1][axis]);
    EXPECT_EQ(steps, 1) << "from place " << i - 1;
  }
}

TEST(BoxMath, TheWholeCurveFitsIntoThirtyBits) {
  for (const int x : {0, 511, 512, 1023}) {
    for (const int z : {0, 1, 1023}) {
      const int place = tri_hilbert_place(x, 1023 - x, z);
      EXPECT_GE(place, 0);
      EXPECT_LT(place, 1 << 30);
    }
  }
}

TEST(BoxMath, GridCellsAreClampedAndNeverUndefined) {
  EXPECT_EQ(tri_grid_cell(0.5F, 0, 1023), 511);
  EXPECT_EQ(tri_grid_cell(-1, 0, 1023), 0);
  EXPECT_EQ(tri_grid_cell(7, 0, 1023), 1023);
  EXPECT_EQ(tri_grid_cell(std::nanf(""), 0, 1), 0);
  EXPECT_EQ(tri_grid_cell(3e38F, -3e38F, 0), 0);
}

// In double precision, each side of the box lies outside the sphere, but only by a few rounding
// errors.
TEST(BoxMath, BoxesContainTheirSpheres) {
  core::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto c = static_cast<float>(random.uniform(-1, 1) * std::exp2(random.uniform(-20, 20)));
    const auto r = static_cast<float>(std::exp2(random.uniform(-20, 20)));
    const double size = std::abs(static_cast<double>(c)) + static_cast<double>(r);
    const double low = static_cast<double>(c) - static_cast<double>(r);
    const double high = static_cast<double>(c) + static_cast<double>(r);
    EXPECT_LE(static_cast<double>(tri_box_low(c, r)), low);
    EXPECT_GE(static_cast<double>(tri_box_high(c, r)), high);
    EXPECT_NEAR(static_cast<double>(tri_box_low(c, r)), low, 5e-7 * size);
    EXPECT_NEAR(static_cast<double>(tri_box_high(c, r)), high, 5e-7 * size);
  }
}

TEST(BoxMath, HighestIsReachedAtACorner) {
  EXPECT_FLOAT_EQ(tri_box_highest(1, -2, 3, -1, -1, -1, 2, 4, 5), 2 + 2 + 15);
  EXPECT_FLOAT_EQ(tri_box_highest(0, 0, -1, -1, -1, 2, 2, 4, 5), -2);
  EXPECT_FLOAT_EQ(tri_box_reach(-3, 1, -1, 2, 4, 5), 3 + 4 + 5);
}

}  // namespace
}  // namespace triptych::technique
