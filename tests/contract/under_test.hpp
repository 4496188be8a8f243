#pragma once
// Opens the backend under test and loops over its devices, one after another. All contract tests
// begin with this.

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "measure/contract/backend.hpp"
#include "record/one_per_driver.hpp"
#include "scene/generators.hpp"
#include "tests/support/exhaustive_run.hpp"

namespace triptych::contract {

[[nodiscard]] std::unique_ptr<measure::Backend> backend_under_test();

// Runs `body` on every device. If there is no device, skips the test and prints the backend's
// reasons.
inline void on_devices(const std::function<void(measure::Device&)>& body, bool one_per_driver) {
  const auto backend = backend_under_test();
  measure::Listing listing = backend->list();
  if (listing.devices.empty()) {
    std::string reasons;
    for (const measure::Broken& each : listing.broken)
      reasons += each.what + ": " + each.reason + "; ";
    GTEST_SKIP() << "no device: " << reasons;
  }
  if (one_per_driver) listing.devices = record::one_per_driver(listing.devices);
  for (const record::Device& info : listing.devices) {
    SCOPED_TRACE(info.id);
    const auto device = backend->open(info.id);
    body(*device);
  }
}

inline void on_every_device(const std::function<void(measure::Device&)>& body) {
  on_devices(body, false);
}

using test::is_exhaustive_run;

// Runs `body` on one device per driver, or on every device if is_exhaustive_run() is true. Used for
// results that depend only on the driver and the backend, not on how a device is opened.
inline void on_every_driver(const std::function<void(measure::Device&)>& body) {
  on_devices(body, !is_exhaustive_run());
}

inline record::Counts counts_of(measure::Device& device, const measure::Work& work) {
  return device.prepare(work)->frame(measure::Purpose::counters).counts;
}

// Returns work that draws the scene on the device's default path, which is its preferred voxel
// format and sampler.
inline measure::Work default_work(const measure::Device& device, scene::Volume volume,
                                  scene::VolumeScene scene) {
  const measure::VolumePath path =
      device.default_path({.native = scene::lossless_format(volume.type), .size = volume.size});
  scene.grid =
      std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(volume), path.voxel));
  scene.camera = scene::camera_at("orbit_y:1/8", scene.box(), 90);
  return {.technique = "raycast",
          .scene =
              measure::VolumeWork{.scene = std::move(scene), .options = {.sampler = path.sampler}}};
}

// Returns the image of one frame.
inline core::Image draw(measure::Device& device, const measure::Work& work) {
  const auto prepared = device.prepare(work);
  static_cast<void>(prepared->frame(measure::Purpose::timing));
  return prepared->image();
}

inline scene::VolumeScene small_scene(std::string_view transfer_function) {
  return {.transfer_function = scene::load_transfer_function(transfer_function),
          .width = 64,
          .height = 48,
          .step_voxels = 0.5};
}

}  // namespace triptych::contract
