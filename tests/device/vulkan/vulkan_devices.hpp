#pragma once
// The devices and the scenes that the cases here run with.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "backends/vulkan/backend.hpp"
#include "measure/backend.hpp"
#include "scene/generators.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::vulkan_backend {

// With the validation layer where it is installed: then any message of it fails the case.
inline std::unique_ptr<measure::Backend> validated_backend() {
  for (const char* folder : {"/usr/share/vulkan", "/usr/local/share/vulkan", "/etc/vulkan"}) {
    if (std::filesystem::exists(std::filesystem::path(folder) / "explicit_layer.d" /
                                "VkLayer_khronos_validation.json")) {
      setenv("TRIPTYCH_VULKAN_VALIDATION", "1", 1);
    }
  }
  return make_backend();
}

// Runs `check(device)` for every device; skips the case with the reasons where none is.
template <class Check>
void for_each_device(Check&& check) {
  const auto backend = validated_backend();
  const measure::Listing listing = backend->list();
  if (listing.devices.empty()) {
    std::string reasons;
    for (const measure::Broken& each : listing.broken) {
      reasons += each.what + ": " + each.reason + "; ";
    }
    GTEST_SKIP() << reasons;
  }
  for (const record::Device& each : listing.devices) {
    SCOPED_TRACE(each.id);
    const auto device = backend->open(each.id);
    check(*device);
  }
}

struct SceneOptions {
  std::string_view data = "generate:mandelbulb:40";
  std::string_view transfer_function = "surfaces";
  std::string_view camera = "orbit_y:1/8";
  scene::VoxelFormat voxel = scene::VoxelFormat::f32;
  int width = 37;
  int height = 26;
  double step_voxels = 0.5;
  bool shading = false;
};

inline scene::VolumeScene make_scene(const SceneOptions& options = {}) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::load_volume(options.data), options.voxel));
  scene.transfer_function = scene::load_transfer_function(options.transfer_function);
  scene.camera = scene::camera_at(options.camera, scene.box(), 50);
  scene.width = options.width;
  scene.height = options.height;
  scene.step_voxels = options.step_voxels;
  scene.shading.enabled = options.shading;
  scene.background = {0.05F, 0.1F, 0.2F, 0.5F};
  return scene;
}

inline measure::Work make_work(std::string_view technique, scene::VolumeScene scene,
                               const technique::RaycastOptions& options = {}) {
  return {std::string(technique), measure::VolumeWork{std::move(scene), options}};
}

inline core::Image picture(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  return prepared->image();
}

}  // namespace triptych::vulkan_backend
