// Tests listing and opening devices, and their limits.
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "core/error.hpp"
#include "tests/device/vulkan/vulkan_devices.hpp"

namespace triptych::vulkan_backend {
namespace {

using scene::VoxelFormat;
using technique::Sampler;
using testing::HasSubstr;

TEST(VulkanDevices, IdsAreUniqueAndWellFormed) {
  const measure::Listing listing = make_backend()->list();
  std::set<std::string> ids;
  for (const record::Device& each : listing.devices) {
    EXPECT_TRUE(std::regex_match(each.id, std::regex("vulkan:[a-z0-9-]+(#[2-9][0-9]*)?")))
        << each.id;
    EXPECT_TRUE(ids.insert(each.id).second) << each.id;
    EXPECT_EQ(each.api, "vulkan");
    EXPECT_FALSE(each.driver_version.empty());
    EXPECT_TRUE(each.limits.contains("maxImageDimension3D"));
    EXPECT_EQ(each.limits.at("deviceType") == "Cpu", !each.cpu_features.empty()) << each.id;
  }
}

TEST(VulkanDevices, LavapipeIsNamedByItsVersion) {
  for (const record::Device& each : make_backend()->list().devices) {
    if (each.driver != "llvmpipe") continue;
    EXPECT_EQ(each.id.substr(0, 15), "vulkan:lavapipe");
    EXPECT_THAT(each.driver_version, HasSubstr("LLVM"));
  }
}

TEST(VulkanDevices, VariablesThatChangeCodeBelongToTheDevice) {
  setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  const measure::Listing listing = make_backend()->list();
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  for (const record::Device& each : listing.devices) {
    EXPECT_EQ(each.environment.at("LP_NATIVE_VECTOR_WIDTH"), "128");
  }
}

TEST(VulkanDevices, ALoaderWithoutDriversIsReportedAsBroken) {
  setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
  setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
  const measure::Listing listing = make_backend()->list();
  unsetenv("VK_ICD_FILENAMES");
  unsetenv("VK_DRIVER_FILES");
  EXPECT_TRUE(listing.devices.empty());
  ASSERT_EQ(listing.broken.size(), 1U);
  EXPECT_THAT(listing.broken[0].reason, HasSubstr("ErrorIncompatibleDriver"));
}

TEST(VulkanDevices, UnknownDevicesAreNotSupported) {
  const auto backend = make_backend();
  if (backend->list().devices.empty()) GTEST_SKIP() << "no Vulkan device";
  EXPECT_THROW(static_cast<void>(backend->open("vulkan:none")), core::NotSupported);
}

TEST(VulkanDevices, DriversThatSkipWorkAreNotOpened) {
  const auto backend = make_backend();
  for (const record::Device& each : backend->list().devices) {
    if (each.driver != "llvmpipe") continue;
    setenv("LP_PERF", "no_tex", 1);
    EXPECT_THROW(static_cast<void>(backend->open(each.id)), core::NotSupported);
    unsetenv("LP_PERF");
  }
}

TEST(VulkanDevices, TheDefaultPathFiltersExactly) {
  for_each_device([](measure::Device& device) {
    for (const VoxelFormat native : {VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32}) {
      EXPECT_LT(device.filter_weight_error(device.default_path({native})), 1e-5);
      EXPECT_EQ(device.filter_weight_error({native, Sampler::manual}), 0);
    }
    if (device.info().driver != "llvmpipe") return;
    // The sampler `packed`, which loads cells of eight voxels, is the fastest exact sampler, but it
    // is used only for volumes of up to a gigabyte.
    EXPECT_EQ(device.default_path({VoxelFormat::u8}).sampler, Sampler::packed);
    EXPECT_EQ(device.default_path({VoxelFormat::u8}).voxel, VoxelFormat::u8);
    for (const measure::VolumeKind& other :
         {measure::VolumeKind{.native = VoxelFormat::u8, .size = {600, 600, 600}},
          measure::VolumeKind{.native = VoxelFormat::u8, .sampler = Sampler::hardware}}) {
      EXPECT_EQ(device.default_path(other).sampler, Sampler::hardware);
      EXPECT_EQ(device.default_path(other).voxel, VoxelFormat::f32);
    }
    // The results of this driver's linear sampling have only 8 bits if the voxels have 8 bits.
    EXPECT_GT(device.filter_weight_error({VoxelFormat::u8, Sampler::hardware}), 1e-3);
  });
}

TEST(VulkanDevices, ExceededLimitsAreReportedWithBothNumbers) {
  for_each_device([](measure::Device& device) {
    const std::string limit = device.info().limits.at("maxImageDimension3D");
    const int beyond = std::stoi(limit) + 1;
    scene::VoxelGrid grid{.format = VoxelFormat::u8, .size = {beyond, 1, 1}};
    grid.data.resize(static_cast<std::size_t>(beyond));
    scene::VolumeScene scene = make_scene();
    scene.grid = std::make_shared<const scene::VoxelGrid>(std::move(grid));
    const auto reason = device.unsupported(make_work("raycast", scene));
    ASSERT_TRUE(reason);
    EXPECT_THAT(*reason, HasSubstr(std::to_string(beyond)));
    EXPECT_THAT(*reason, HasSubstr(limit));
    EXPECT_THROW(static_cast<void>(device.prepare(make_work("raycast", scene))),
                 core::NotSupported);

    for (const std::string_view technique : {"raycast", "raycast_fragment"}) {
      scene::VolumeScene wide = make_scene();
      wide.width = 1 << 20;
      wide.height = 1 << 10;
      const auto too_wide = device.unsupported(make_work(technique, wide));
      ASSERT_TRUE(too_wide) << technique;
      EXPECT_THAT(*too_wide, HasSubstr("1048576x1024"));
    }
    EXPECT_TRUE(device.unsupported(make_work("quad_screen", make_scene())));
    EXPECT_FALSE(device.unsupported(make_work("raycast", make_scene())));
  });
}

}  // namespace
}  // namespace triptych::vulkan_backend
