// Tests the short names of drivers, derived from the strings that the drivers report.
#include <gmock/gmock.h>

#include "backends/gl/device_info.hpp"

namespace triptych::gl_backend {
namespace {

struct Strings {
  const char* vendor;
  const char* renderer;
  const char* version;
};

constexpr Strings llvmpipe{"Mesa", "llvmpipe (LLVM 15.0.6, 256 bits)",
                           "4.5 (Core Profile) Mesa 22.3.6"};
constexpr Strings zink{"Mesa", "zink Vulkan 1.3(llvmpipe (LLVM 19.1.7, 256 bits) (MESA_LLVMPIPE))",
                       "4.6 (Core Profile) Mesa 25.0.7"};
constexpr Strings virgl{"Mesa", "virgl (LLVMPIPE (LLVM 15.0.6, 256 bits))",
                        "4.3 (Core Profile) Mesa 22.3.6"};
constexpr Strings angle{"Google Inc. (NVIDIA)",
                        "ANGLE (NVIDIA, Vulkan 1.3.277 (NVIDIA H200), NVIDIA-580.159)",
                        "4.1.0 ANGLE 2.1.1"};

std::string name_of(const Strings& strings) {
  return driver_name(strings.vendor, strings.renderer);
}

std::string version_of(const Strings& strings) {
  return driver_version(strings.version, strings.renderer);
}

TEST(DeviceNames, LayeredDriversHaveTheirOwnNames) {
  EXPECT_EQ(name_of(llvmpipe), "llvmpipe");
  EXPECT_EQ(name_of(zink), "zink");
  EXPECT_EQ(name_of(virgl), "virgl");
  EXPECT_EQ(name_of(angle), "angle");
  EXPECT_EQ(driver_name("NVIDIA Corporation", "NVIDIA H200/PCIe/SSE2"), "nvidia");
}

TEST(DeviceNames, VersionsIncludeTheDriverBelow) {
  EXPECT_EQ(version_of(llvmpipe), "Mesa 22.3.6 (LLVM 15.0.6)");
  EXPECT_EQ(version_of(zink), "Mesa 25.0.7 on llvmpipe (LLVM 19.1.7, 256 bits) (MESA_LLVMPIPE)");
  EXPECT_EQ(version_of(virgl), "Mesa 22.3.6 on LLVMPIPE (LLVM 15.0.6, 256 bits)");
  EXPECT_EQ(version_of(angle),
            "ANGLE 2.1.1 on NVIDIA, Vulkan 1.3.277 (NVIDIA H200), NVIDIA-580.159");
}

TEST(DeviceNames, SoftwareRenderersBelowLayeredDriversAreDetected) {
  record::Device device;
  device.driver = "zink";
  device.driver_version = version_of(zink);
  EXPECT_TRUE(is_software(device));
  device.driver = "angle";
  device.driver_version = version_of(angle);
  EXPECT_FALSE(is_software(device));
}

}  // namespace
}  // namespace triptych::gl_backend
