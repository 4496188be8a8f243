// Tests the stress cases (numbered in suites/volume/stress_cases.cpp) that need more than a single
// image: a hundred transfer functions, a hundred repeats, denormals.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "measure/plan/plan.hpp"
#include "scene/denormals.hpp"
#include "suites/volume/stress_cases.hpp"
#include "suites/volume/suite.hpp"
#include "technique/catalogue.hpp"
#include "under_test.hpp"

namespace triptych::contract {
namespace {

using volume_suite::stress_data;
using volume_suite::stress_scene;
using volume_suite::StressScene;

measure::Work work_of(const measure::Device& device, StressScene stress) {
  const measure::VolumePath path = device.default_path(
      {.native = scene::lossless_format(stress.volume.type), .size = stress.volume.size});
  scene::VolumeScene scene{.grid = std::make_shared<const scene::VoxelGrid>(
                               scene::encode(std::move(stress.volume), path.voxel)),
                           .transfer_function = scene::without_denormals(stress.function),
                           .camera = stress.camera,
                           .width = stress.width,
                           .height = stress.height,
                           .step_voxels = stress.step_voxels,
                           .shading = {.enabled = stress.shaded},
                           .background = stress.background};
  return {.technique = "raycast",
          .scene = measure::VolumeWork{.scene = std::move(scene),
                                       .options = {.sampler = path.sampler, .ert = stress.ert}}};
}

core::Image draw_skipping(measure::Device& device, measure::Work work, technique::Skip skip) {
  std::get<measure::VolumeWork>(work.scene).options.skip = skip;
  return draw(device, work);
}

// Case 28: for every transfer function, images with and without skipping must be bit-identical.
TEST(Stress, AHundredTransferFunctions) {
  const auto edit = stress_data("stress:edit:1");
  on_every_device([&](measure::Device& device) {
    for (int seed = 1; seed <= 100; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const measure::Work work = work_of(device, edit->of->scene(std::to_string(seed)));
      const core::Image without = draw_skipping(device, work, technique::Skip::none);
      const auto skip = seed % 2 == 0 ? technique::Skip::bricks : technique::Skip::distance;
      EXPECT_EQ(draw_skipping(device, work, skip), without);
    }
  });
}

// Case 55: with and without early termination, a hundred repeats must give bit-identical images.
TEST(Stress, AHundredRepeatsAreBitIdentical) {
  on_every_device([](measure::Device& device) {
    for (const technique::Technique& technique : technique::catalogue()) {
      measure::Work work = work_of(device, stress_scene(*stress_data("stress:asymmetric")));
      work.technique = technique.id;
      if (technique.suite != "volume" || !technique.draws_image || device.unsupported(work))
        continue;
      SCOPED_TRACE(technique.id);
      const auto prepared = device.prepare(work);
      static_cast<void>(prepared->frame(measure::Purpose::timing));
      const core::Image first = prepared->image();
      for (int repeat = 2; repeat <= 100; ++repeat) {
        static_cast<void>(prepared->frame(measure::Purpose::timing));
        ASSERT_EQ(prepared->image(), first) << "frame " << repeat;
      }
    }
  });
}

// Case 18: denormals may cost time, but an instruction count cannot show that
// (scene/denormals.hpp). Therefore devices must not receive any.
TEST(Stress, NoDenormalsReachADevice) {
  const auto is_denormal = [](float value) {
    return value != 0 && std::abs(value) < std::numeric_limits<float>::min();
  };
  const auto suite = volume_suite::make_suite({});
  const auto defaults = measure::default_plan(*suite, {}).configurations.front();
  on_every_device([&](measure::Device& device) {
    for (const char* variant : {"voxels", "opacity", "colour", "transmittance"}) {
      SCOPED_TRACE(variant);
      measure::Configuration configuration = defaults;
      configuration["data"] = std::string("stress:denormal:") + variant;
      configuration["transfer_function"] = "own";
      configuration["voxel"] = "f32";
      const measure::Work work = suite->work(configuration, device);
      const scene::VolumeScene& scene = std::get<measure::VolumeWork>(work.scene).scene;
      std::vector<float> voxels(scene.grid->data.size() / sizeof(float));
      std::memcpy(voxels.data(), scene.grid->data.data(), scene.grid->data.size());
      ASSERT_EQ(scene.grid->format, scene::VoxelFormat::f32);
      EXPECT_TRUE(std::ranges::none_of(voxels, is_denormal));
      for (const auto& entry : scene.transfer_function.entries) {
        EXPECT_TRUE(std::ranges::none_of(entry, is_denormal));
      }
    }
  });
}

}  // namespace
}  // namespace triptych::contract
