// Tests listing and opening devices, and the properties that devices report.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "core/error.hpp"
#include "tests/device/gl/gl_devices.hpp"

namespace triptych::gl_backend {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;

std::vector<std::string> ids(const measure::Listing& listing) {
  std::vector<std::string> result;
  for (const record::Device& device : listing.devices) result.push_back(device.id);
  return result;
}

TEST(GlDevices, ListingTwiceGivesTheSameDevices) {
  const auto backend = backend_under_test();
  const measure::Listing first = backend->list();
  const measure::Listing second = backend->list();
  EXPECT_EQ(first.devices, second.devices);
  EXPECT_EQ(first.broken.size(), second.broken.size())
      << (second.broken.empty() ? "" : second.broken.back().reason);
  const std::vector<std::string> all = ids(first);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  for (const std::string& id : all) {
    EXPECT_THAT(id, MatchesRegex("gl:[a-z0-9_]+.*"));
    // llvmpipe always renders on the CPU, so it must be listed as a single device, no matter in how
    // many ways EGL offers it.
    EXPECT_FALSE(id.starts_with("gl:llvmpipe") && id.ends_with("#2")) << id;
  }
}

TEST(GlDevices, ListedDevicesCanBeOpened) {
  const auto backend = backend_under_test();
  for (const record::Device& each : backend->list().devices) {
    EXPECT_EQ(backend->open(each.id)->info(), each);
    EXPECT_FALSE(each.name.empty());
    EXPECT_FALSE(each.driver_version.empty());
  }
}

// tests/device/gl/CMakeLists.txt runs this test several times with GL 3.3, each time with a
// different extension disabled.
TEST(GlDevices, AnExtensionThatIsMissingIsNamed) {
  const char* without = std::getenv("MESA_EXTENSION_OVERRIDE");
  if (without == nullptr) GTEST_SKIP() << "MESA_EXTENSION_OVERRIDE removes no extension";
  const auto backend = backend_under_test();
  const std::vector<record::Device> devices = backend->list().devices;
  EXPECT_FALSE(devices.empty());
  for (const record::Device& each : devices) {
    const auto reason = backend->open(each.id)->unsupported(make_work("raycast", make_scene(), {}));
    EXPECT_THAT(reason.value_or("it can"), HasSubstr(without + 1)) << each.id;
  }
}

TEST(GlDevices, AnUnknownDeviceIsNotSupported) {
  const auto backend = backend_under_test();
  for (const char* id : {"gl:nothing-egl", "gl:nothing-osmesa"}) {
    try {
      static_cast<void>(backend->open(id));
      ADD_FAILURE() << id << " opened";
    } catch (const core::NotSupported& error) {
      EXPECT_THAT(error.what(), HasSubstr(id));
    }
  }
}

// EGL and OSMesa store the thread's current context in the same variable.
TEST(GlDevices, TwoOpenDevicesDoNotAffectEachOther) {
  const auto backend = backend_under_test();
  const std::vector<std::string> all = ids(backend->list());
  if (all.size() < 2) GTEST_SKIP() << "fewer than two OpenGL devices";
  const auto a = backend->open(all[0]);
  const auto b = backend->open(all[1]);
  const measure::Work work = make_work("raycast", make_scene({}));
  const auto on_a = a->prepare(work);
  const auto on_b = b->prepare(work);
  static_cast<void>(on_a->frame(measure::Purpose::timing));
  const core::Image alone = on_a->image();
  static_cast<void>(on_b->frame(measure::Purpose::timing));
  static_cast<void>(on_a->frame(measure::Purpose::timing));
  EXPECT_EQ(on_a->image(), alone);
  EXPECT_LT(largest_difference(on_b->image(), alone), 1e-4);
}

TEST(GlDevices, TheDefaultPathIsAsExactAsManualInterpolation) {
  for_each_device([](const measure::Device& device) {
    for (const auto native : {scene::VoxelFormat::u8, scene::VoxelFormat::u16}) {
      const measure::VolumePath path = device.default_path({native});
      EXPECT_LT(device.filter_weight_error(path), 1e-5);
      if (path.sampler != technique::Sampler::hardware) {
        EXPECT_EQ(path.voxel, native);
      }
    }
    // This driver's sampler is known to be exact, so an error would come from the probe that
    // measures samplers.
    if (device.info().driver == "llvmpipe") {
      const measure::VolumePath path = device.default_path({scene::VoxelFormat::u8});
      EXPECT_EQ(path.voxel, scene::VoxelFormat::u8);
      EXPECT_EQ(path.sampler, technique::Sampler::packed);
      const measure::VolumePath filtered = device.default_path(
          {.native = scene::VoxelFormat::u8, .sampler = technique::Sampler::hardware});
      EXPECT_EQ(filtered.voxel, scene::VoxelFormat::f32);
      EXPECT_EQ(filtered.sampler, technique::Sampler::hardware);
    }
    for (const auto voxel : {scene::VoxelFormat::u8, scene::VoxelFormat::f32}) {
      const double error = device.filter_weight_error({voxel, technique::Sampler::hardware});
      EXPECT_GE(error, 0);
      EXPECT_LE(error, 1);
      EXPECT_EQ(device.filter_weight_error({voxel, technique::Sampler::manual}), 0);
    }
  });
}

TEST(GlDevices, ExceededLimitsAreReportedWithBothNumbers) {
  for_each_device([](const measure::Device& device) {
    scene::VolumeScene scene = make_scene({});
    auto grid = *scene.grid;
    grid.size = {1'000'000, 1, 1};
    scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
    const auto large_volume = device.unsupported(make_work("raycast", scene));
    ASSERT_TRUE(large_volume);
    EXPECT_THAT(*large_volume, HasSubstr("1000000x1x1"));
    EXPECT_THAT(*large_volume, HasSubstr(device.info().limits.at("GL_MAX_3D_TEXTURE_SIZE")));

    for (const std::string_view technique : image_techniques) {
      scene = make_scene({.width = 1'000'000, .height = 1'000});
      EXPECT_TRUE(device.unsupported(make_work(technique, scene)));
      scene = make_scene({.width = 1'000'000, .height = 1});
      EXPECT_TRUE(device.unsupported(make_work(technique, scene)));
      EXPECT_FALSE(device.unsupported(make_work(technique, make_scene({}))));
    }
    EXPECT_TRUE(device.unsupported(make_work("no_such_technique", make_scene({}))));
  });
}

// A scene is rejected even if only the frames that count work need a larger buffer than the limit
// permits.
TEST(GlDevices, CountersAndBrickMapsMustFitIntoAStorageBlock) {
  static constexpr const char* limit = "GL_MAX_SHADER_STORAGE_BLOCK_SIZE";
  for_each_device([](const measure::Device& device) {
    const double most = std::stod(device.info().limits.at(limit));
    const int edge = std::stoi(device.info().limits.at("GL_MAX_3D_TEXTURE_SIZE"));
    scene::VolumeScene scene = make_scene({.voxel = scene::VoxelFormat::u8});
    auto grid = *scene.grid;
    // The edge of a volume whose brick map exceeds the limit. The map has 4 bytes for each brick of
    // 2³ cells.
    const int bricked = static_cast<int>(2 * std::cbrt(most / 4)) + 3;
    if (bricked <= edge) {
      grid.size = {bricked, bricked, bricked};
      scene.grid = std::make_shared<const scene::VoxelGrid>(grid);
      const std::string reason =
          device.unsupported(make_work("raycast", scene, {.skip = technique::Skip::distance}))
              .value_or("");
      if (most < 0x1p27) {
        EXPECT_THAT(reason, AllOf(HasSubstr("brick map"), HasSubstr(limit)));
      } else {
        EXPECT_EQ(reason, "");  // with larger bricks, the map fits
      }
      EXPECT_FALSE(
          device.unsupported(make_work("raycast", scene, {.skip = technique::Skip::bricks})));
    }
    scene = make_scene({.width = static_cast<int>(most / 32 / 64) + 1, .height = 64});
    EXPECT_THAT(device.unsupported(make_work("raycast_fragment", scene)).value_or(""),
                AllOf(HasSubstr("counters"), HasSubstr(limit)));
  });
}

}  // namespace
}  // namespace triptych::gl_backend
