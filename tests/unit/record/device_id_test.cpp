#include "record/device_id.hpp"

#include <gtest/gtest.h>

namespace triptych::record {
namespace {

TEST(DeviceIdTest, TheSecondDeviceOfADriverIsNumberTwo) {
  EXPECT_EQ(numbered_id("opencl:pocl", 1), "opencl:pocl");
  EXPECT_EQ(numbered_id("opencl:pocl", 2), "opencl:pocl#2");
  EXPECT_EQ(numbered_id("opencl:pocl", 10), "opencl:pocl#10");
}

TEST(DeviceIdTest, DriversOfOneProjectAreOneFamily) {
  EXPECT_EQ(family_of("vulkan:lavapipe"), "llvmpipe");
  EXPECT_EQ(family_of("gl:llvmpipe-osmesa#2"), "llvmpipe");
  EXPECT_EQ(family_of("gl:softpipe"), "softpipe");
  EXPECT_EQ(family_of("opencl:pocl#2"), "pocl");
}

}  // namespace
}  // namespace triptych::record
