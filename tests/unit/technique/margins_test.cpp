#include "technique/particles/margins.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace triptych::technique {
namespace {

TEST(PointMargin, IsTheGranularityOfPointSizes) {
  EXPECT_EQ(point_margin("Some GPU (llvmpipe is not its name)", 0.125), 0.125);
  EXPECT_EQ(point_margin("Some GPU", 1), 1);
}

TEST(SpriteGrowth, CoversWhatTheGridMovesAnEdge) {
  EXPECT_EQ(sprite_growth(8), 0);
  EXPECT_EQ(sprite_growth(7), 0);
  EXPECT_EQ(sprite_growth(4), 1.0 / 8 - 1.0 / 64);
  for (int bits = 4; bits <= 8; ++bits) {
    EXPECT_GT(1.0 / 64 + sprite_growth(bits), std::sqrt(2) * std::ldexp(1, -bits));
  }
}

TEST(PointMargin, KnowsTheSoftwareDrivers) {
  EXPECT_EQ(point_margin("llvmpipe (LLVM 15.0.6, 256 bits)", 0.125), 0);
  EXPECT_EQ(point_margin("softpipe", 0.1), 2);
}

}  // namespace
}  // namespace triptych::technique
