// What of the stress catalogue is no single picture: a hundred transfer functions, a hundred
// repeats, the time that denormals cost.

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "scene/denormals.hpp"
#include "suites/volume/stress_cases.hpp"
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

// Case 28: whatever the function, skipping changes no bit.
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

// Case 55, with early termination and without.
TEST(Stress, AHundredRepeatsHaveTheSameBits) {
  on_every_device([](measure::Device& device) {
    for (const technique::Technique& technique : technique::catalogue()) {
      measure::Work work = work_of(device, stress_scene(*stress_data("stress:asymmetric")));
      work.technique = technique.id;
      if (technique.suite != "volume" || !technique.picture || device.unsupported(work)) continue;
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

// A scene of case 18, and the same with numbers that are as small as they need be but not denormal.
struct Denormal {
  std::string_view variant;
  float ordinary;
};

StressScene made_ordinary(StressScene scene, const Denormal& denormal) {
  if (denormal.variant == "voxels") {
    scene.volume = stress_scene(*stress_data("stress:nan:zero_one")).volume;  // of the same size
    return scene;
  }
  for (auto& entry : scene.function.entries) {
    for (float& value : entry) {
      const bool is_denormal = value > 0 && value < std::numeric_limits<float>::min();
      const bool makes_them = denormal.variant == "transmittance" && &value == &entry.back();
      if (is_denormal || makes_them) value = denormal.ordinary;
    }
  }
  return scene;
}

double least_ns(measure::Prepared& prepared, double least) {
  return std::min(least, prepared.frame(measure::Purpose::timing).wall_ns);
}

// Case 18: the least of frames drawn in turns, so that a busy machine slows both; a few more rounds
// where it was too busy for the least to be seen.
TEST(Stress, DenormalsTakeNoMoreTime) {
  constexpr double allowed = 1.2;
  on_every_device([](measure::Device& device) {
    for (const Denormal& denormal : {Denormal{"voxels", 0}, Denormal{"opacity", 1e-6F},
                                     Denormal{"colour", 1e-3F}, Denormal{"transmittance", 0.5F}}) {
      SCOPED_TRACE(std::string(denormal.variant));
      StressScene scene =
          stress_scene(*stress_data("stress:denormal:" + std::string(denormal.variant)));
      scene.width = scene.height = 96;
      const auto ordinary = device.prepare(work_of(device, made_ordinary(scene, denormal)));
      const auto tiny = device.prepare(work_of(device, scene));
      std::array<double, 2> least{std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()};
      for (int frame = 0; frame < 200 && (frame < 20 || least[1] > allowed * least[0]); ++frame) {
        least = {least_ns(*ordinary, least[0]), least_ns(*tiny, least[1])};
      }
      EXPECT_LE(least[1], allowed * least[0]);
    }
  });
}

}  // namespace
}  // namespace triptych::contract
