#include "record/device_id.hpp"

#include <gtest/gtest.h>

namespace triptych::record {
namespace {

TEST(DeviceIdTest, TheSecondOfADriverIsNumberTwo) {
  EXPECT_EQ(numbered_id("opencl:pocl", 1), "opencl:pocl");
  EXPECT_EQ(numbered_id("opencl:pocl", 2), "opencl:pocl#2");
  EXPECT_EQ(numbered_id("opencl:pocl", 10), "opencl:pocl#10");
}

}  // namespace
}  // namespace triptych::record
