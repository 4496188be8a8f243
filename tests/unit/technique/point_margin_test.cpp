#include "technique/particles/point_margin.hpp"

#include <gtest/gtest.h>

namespace triptych::technique {
namespace {

TEST(PointMargin, IsTheGranularityWhereSizesMayBeRounded) {
  EXPECT_EQ(point_margin("Some GPU (llvmpipe is not its name)", 0.125), 0.125);
  EXPECT_EQ(point_margin("Some GPU", 1), 1);
}

TEST(PointMargin, KnowsTheSoftwareDrivers) {
  EXPECT_EQ(point_margin("llvmpipe (LLVM 15.0.6, 256 bits)", 0.125), 0);
  EXPECT_EQ(point_margin("softpipe", 0.1), 2);
}

}  // namespace
}  // namespace triptych::technique
