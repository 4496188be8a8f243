#pragma once
// Devices and scenes for tests on real devices, for every API.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "measure/contract/backend.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::test {

// Runs `check(device)` for each available device. If there is no device, skips the test and prints
// the reasons.
template <class Check>
void for_each_device_of(const measure::Backend& backend, Check&& check) {
  const measure::Listing listing = backend.list();
  if (listing.devices.empty()) {
    std::string reasons;
    for (const measure::Broken& each : listing.broken) {
      reasons += each.what + ": " + each.reason + "; ";
    }
    GTEST_SKIP() << reasons;
  }
  for (const record::Device& each : listing.devices) {
    SCOPED_TRACE(each.id);
    const auto device = backend.open(each.id);
    check(*device);
  }
}

struct SceneOptions {
  std::string_view data = "generate:mandelbulb:40";
  std::string_view transfer_function = "surfaces";
  std::string_view camera = "orbit_y:1/8";
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  int width = 33;
  int height = 29;
  double step_voxels = 0.7;
  bool shading = false;
};

inline scene::VolumeScene make_scene(const SceneOptions& options = {}) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::load_volume(options.data), options.voxel));
  scene.transfer_function = scene::load_transfer_function(options.transfer_function);
  scene.camera = scene::camera_at(options.camera, scene.box(), 40);
  scene.width = options.width;
  scene.height = options.height;
  scene.step_voxels = options.step_voxels;
  scene.shading.enabled = options.shading;
  scene.background = {0.1F, 0.2F, 0.3F, 1.0F};
  return scene;
}

inline measure::Work make_work(std::string_view technique, scene::VolumeScene scene,
                               const technique::RaycastOptions& options = {}) {
  return {std::string(technique), measure::VolumeWork{std::move(scene), options}};
}

// Returns the image of one timed frame.
inline core::Image draw_image(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  return prepared->image();
}

// Returns the largest difference. It is infinite if the sizes differ or if a value is not finite.
inline double largest_difference(const core::Image& a, const core::Image& b) {
  if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    const double difference =
        std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

// Checks that frames for all purposes draw the same image, and that a later timed frame does too.
inline void expect_same_image(measure::Prepared& prepared) {
  using measure::Purpose;
  static_cast<void>(prepared.frame(Purpose::timing));
  const core::Image timed = prepared.image();
  for (const Purpose purpose : {Purpose::statistics, Purpose::counters, Purpose::timing}) {
    static_cast<void>(prepared.frame(purpose));
    EXPECT_EQ(prepared.image(), timed);
  }
}

}  // namespace triptych::test
