// Tests listing and opening devices, and the properties that devices report.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <set>

#include "backends/opencl/devices.hpp"
#include "core/error.hpp"
#include "tests/device/opencl/opencl_devices.hpp"

namespace triptych::opencl_backend {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(OpenClDevices, ListingTwiceGivesTheSameDevices) {
  const auto backend = make_backend();
  const measure::Listing first = backend->list();
  EXPECT_EQ(first.devices, backend->list().devices);
  std::set<std::string> ids;
  for (const record::Device& each : first.devices) {
    EXPECT_TRUE(ids.insert(each.id).second) << each.id;
    EXPECT_THAT(each.id, MatchesRegex("opencl:[a-z0-9]+(#[0-9]+)?"));
  }
  EXPECT_FALSE(first.devices.empty() && first.broken.empty());
}

// Tests platforms that list no devices, such as Clover without hardware, or rusticl without its
// environment variable.
TEST(OpenClDevices, AnEmptyPlatformIsReportedAndAffectsNothingElse) {
  const measure::Listing listing = make_backend()->list();
  for (const measure::Broken& each : listing.broken) {
    EXPECT_THAT(each.what, testing::StartsWith("OpenCL "));
    EXPECT_FALSE(each.reason.empty()) << each.what;
  }
  std::size_t platforms = 0;
  std::vector<cl::Platform> all;
  try {
    cl::Platform::get(&all);
    platforms = all.size();
  } catch (const cl::Error&) {
    GTEST_SKIP() << listing.broken.front().reason;
  }
  EXPECT_GE(listing.devices.size() + listing.broken.size(), platforms);
}

TEST(OpenClDevices, ListedDevicesCanBeOpened) {
  const auto backend = make_backend();
  for (const record::Device& each : backend->list().devices) {
    EXPECT_EQ(backend->open(each.id)->info(), each);
    EXPECT_EQ(each.api, backend->api());
    EXPECT_FALSE(each.name.empty());
    EXPECT_FALSE(each.driver_version.empty());
  }
}

TEST(OpenClDevices, VariablesThatChangeCodeBelongToTheDevice) {
  const auto environment_with = [](const char* value) {
    setenv("POCL_WORK_GROUP_METHOD", value, 1);
    setenv("POCL_PTHREAD_MIN_WGS", "1", 1);
    const measure::Listing listing = make_backend()->list();
    unsetenv("POCL_WORK_GROUP_METHOD");
    return listing.devices;
  };
  for (const record::Device& each : environment_with("loops")) {
    EXPECT_THAT(each.environment,
                testing::Contains(testing::Pair("POCL_WORK_GROUP_METHOD", "loops")));
    EXPECT_EQ(each.environment.count("POCL_PTHREAD_MIN_WGS"), 0U);  // set by Triptych itself
    if (each.driver == "pocl") {
      EXPECT_FALSE(each.cpu_features.empty());
    }
  }
}

TEST(OpenClDevices, AnUnknownDeviceIsNotSupported) {
  try {
    static_cast<void>(make_backend()->open("opencl:nothing"));
    ADD_FAILURE();
  } catch (const core::NotSupported& error) {
    EXPECT_THAT(error.what(), HasSubstr("opencl:nothing"));
  }
}

TEST(OpenClDevices, DriversHaveShortNames) {
  EXPECT_EQ(driver_of("Portable Computing Language"), "pocl");
  EXPECT_EQ(driver_of("rusticl"), "rusticl");
  EXPECT_EQ(driver_of("NVIDIA CUDA"), "nvidia");
  EXPECT_EQ(driver_of("Some New Platform!"), "somenewplatform");
  EXPECT_EQ(driver_of(""), "unknown");
}

TEST(OpenClDevices, TheDefaultPathIsAsExactAsManualInterpolation) {
  for_each_device([](const measure::Device& device) {
    for (const auto native : {scene::VoxelFormat::u8, scene::VoxelFormat::u16}) {
      const measure::VolumePath path = device.default_path({native});
      EXPECT_LT(device.filter_weight_error(path), 1e-5);
    }
    for (const auto voxel :
         {scene::VoxelFormat::u8, scene::VoxelFormat::u16, scene::VoxelFormat::f32}) {
      const double error = device.filter_weight_error({voxel, technique::Sampler::hardware});
      // Any error is accepted for u8, because the coarsest known sampler then rounds its results to
      // 8 bits more than once.
      EXPECT_LT(error, voxel == scene::VoxelFormat::u8 ? 2 : 0.01);
      std::printf("%s %s sampler error %.3g\n", device.info().id.c_str(),
                  std::string(scene::name_of(voxel)).c_str(), error);
      EXPECT_EQ(device.filter_weight_error({voxel, technique::Sampler::manual}), 0);
    }
  });
}

TEST(OpenClDevices, ExceededLimitsAreReportedWithBothNumbers) {
  for_each_device([](const measure::Device& device) {
    scene::VolumeScene scene = make_scene({});
    auto grid = *scene.grid;
    grid.size = {1'000'000, 1, 1};
    scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
    const auto wide =
        device.unsupported(make_work("raycast", scene, {.sampler = technique::Sampler::hardware}));
    ASSERT_TRUE(wide);
    EXPECT_THAT(*wide, HasSubstr("1000000x1x1"));
    EXPECT_THAT(*wide, HasSubstr(device.info().limits.at("CL_DEVICE_IMAGE3D_MAX_WIDTH")));
    EXPECT_FALSE(device.unsupported(make_work("raycast", scene)));

    grid.size = {4096, 4096, 4096};
    scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
    EXPECT_FALSE(device.unsupported(make_work("raycast", scene)))
        << "this volume can be drawn in parts";
    const auto large = device.unsupported(make_work("speed_of_light", scene));
    ASSERT_TRUE(large);
    const std::uint64_t bytes = 68'820'189'192 * scene::bytes_of(grid.format);  // 4098³ voxels
    EXPECT_THAT(*large, HasSubstr(fmt::format("the volume needs {} bytes", bytes)));
    EXPECT_THAT(*large, HasSubstr("cannot draw a volume in parts"));

    scene = make_scene({.width = 1'000'000, .height = 1'000});
    EXPECT_THAT(device.unsupported(make_work("raycast", scene)).value_or(""),
                HasSubstr("1000000000 pixels"));
    EXPECT_TRUE(device.unsupported(make_work("no_such_technique", make_scene({}))));
    EXPECT_FALSE(device.unsupported(make_work("raycast", make_scene({}))));
    EXPECT_FALSE(device.unsupported(make_work("speed_of_light", make_scene({}))));
  });
}

}  // namespace
}  // namespace triptych::opencl_backend
