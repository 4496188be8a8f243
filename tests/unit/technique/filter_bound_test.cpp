#include "technique/volume/filter_bound.hpp"

#include <gtest/gtest.h>

namespace triptych::technique {
namespace {

using enum scene::VoxelFormat;

TEST(FilterBound, DependsOnWeightsAndFormat) {
  EXPECT_DOUBLE_EQ(allowed_filter_error(8, u8), 6.0 / 256);
  EXPECT_DOUBLE_EQ(allowed_filter_error(8, u16), 3.0 / 256 + 3.0 / 2048);
  EXPECT_DOUBLE_EQ(allowed_filter_error(8, f16), allowed_filter_error(8, u16));
  EXPECT_DOUBLE_EQ(allowed_filter_error(8, f32), 3.0 / 256 + 3 * 0x1p-24);
}

// The bound must reject nearest-voxel sampling, whose error halfway between a black and a white
// voxel is 0.5.
TEST(FilterBound, NearestNeighbourSamplingExceedsIt) {
  for (const scene::VoxelFormat format : {u8, u16, f32, f16}) {
    EXPECT_LT(allowed_filter_error(least_weight_bits, format), 0.5);
  }
}

}  // namespace
}  // namespace triptych::technique
