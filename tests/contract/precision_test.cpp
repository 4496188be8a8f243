// Tests precision=fp64 on real devices: images stay within the bound for double precision, which
// single precision exceeds, and fp64 is rejected if any step of the computation would be in single
// precision.

#include <algorithm>
#include <cmath>

#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;

// Uses the suite's default path: voxels in the volume's own format, interpolated in the kernel.
measure::Work fp64_work(const char* data, scene::VolumeScene scene) {
  scene::Volume volume = scene::generate_volume(data, {40, 40, 40});
  const scene::VoxelFormat native = scene::lossless_format(volume.type);
  scene.grid = std::make_shared<const scene::VoxelGrid>(scene::encode(std::move(volume), native));
  scene.camera = scene::camera_at("orbit_y:1/8", scene.box(), 90);
  return {.technique = "raycast",
          .scene = VolumeWork{.scene = std::move(scene),
                              .options = {.sampler = technique::Sampler::manual,
                                          .precision = technique::Precision::fp64}}};
}

// Tests all three voxel types, both techniques, both skip modes, and no skipping.
TEST(Precision, DoubleStaysWithinItsOwnBound) {
  int drawn = 0;
  on_every_driver([&](measure::Device& device) {
    for (const char* data : {"mandelbulb", "marschner_lobb", "sparse_field"}) {
      for (const technique::Skip skip :
           {technique::Skip::none, technique::Skip::bricks, technique::Skip::distance}) {
        for (const char* name : {"raycast", "raycast_fragment"}) {
          for (const double step : {0.5, 0.3}) {
            SCOPED_TRACE(std::string(data) + " " + name);
            scene::VolumeScene scene = small_scene("surfaces");
            scene.shading.enabled = step == 0.5;
            scene.step_voxels = step;
            measure::Work work = fp64_work(data, std::move(scene));
            work.technique = name;
            std::get<VolumeWork>(work.scene).options.skip = skip;
            if (device.unsupported(work)) continue;
            expect_within_bound(device, work);
            ++drawn;
          }
        }
      }
    }
  });
  if (drawn == 0) GTEST_SKIP() << "no device supports double precision";
}

// The bound would prove nothing if single precision stayed within it too.
TEST(Precision, SingleIsNotWithinTheBoundOfDouble) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = small_scene("haze");
    scene.step_voxels = 0.0625;
    measure::Work work = fp64_work("marschner_lobb", std::move(scene));
    if (device.unsupported(work)) GTEST_SKIP() << *device.unsupported(work);
    VolumeWork& volume = std::get<VolumeWork>(work.scene);
    volume.options.ert = 0;
    const reference::Truth truth = reference::render_volume(
        volume.scene,
        volume_suite::error_model(volume.scene, {.precision = technique::Precision::fp64}));
    EXPECT_LE(share_of_bound(draw(device, work), truth), 1);
    volume.options.precision = technique::Precision::fp32;
    EXPECT_GT(share_of_bound(draw(device, work), truth), 2);
  });
}

TEST(Precision, IsRejectedIfAnyStepIsInSinglePrecision) {
  on_every_driver([](measure::Device& device) {
    const auto reason = [&](const auto& change) {
      measure::Work work = fp64_work("marschner_lobb", small_scene("haze"));
      change(work, std::get<VolumeWork>(work.scene));
      return device.unsupported(work).value_or("");
    };
    EXPECT_NE(reason([](measure::Work& work, VolumeWork&) {
                work.technique = "speed_of_light";
              }).find("precision=fp32"),
              std::string::npos);
    EXPECT_NE(reason([](measure::Work&, VolumeWork& volume) {
                volume.scene.quadrature = scene::Quadrature::preintegrated;
              }).find("quadrature=midpoint"),
              std::string::npos);
    EXPECT_NE(reason([](measure::Work&, VolumeWork& volume) {
                volume.options.sampler = technique::Sampler::hardware;
              }).find("sampler=manual"),
              std::string::npos);
  });
}

}  // namespace
}  // namespace triptych::contract
