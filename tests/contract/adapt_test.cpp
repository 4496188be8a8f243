// Tests merging samples within bricks (the factor `adapt`): the error stays within the allowed
// budget, fewer samples are taken, and for V1, a homogeneous box, each ray takes a single sample.

#include <cmath>

#include "data_folder.hpp"
#include "reference/analytic_scenes.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;

technique::RaycastOptions& options_of(measure::Work& work) {
  return std::get<VolumeWork>(work.scene).options;
}

// Selects skip=bricks, with which a ray walks from brick to brick, because samples are merged
// within the bricks of such a walk.
measure::Work walking(measure::Work work) {
  options_of(work).skip = technique::Skip::bricks;
  return work;
}

// Returns work with a generated volume in which most bricks have a single value.
measure::Work generated(const measure::Device& device, std::string_view name,
                        scene::VolumeScene scene) {
  return walking(
      default_work(device, scene::generate_volume(name, {37, 41, 43}), std::move(scene)));
}

core::Image bound_without_budget(const measure::Device& device, const measure::Work& work) {
  const auto& volume = std::get<VolumeWork>(work.scene);
  const measure::VolumePath path{volume.scene.grid->format, volume.options.sampler};
  const auto model = volume_suite::error_model(
      volume.scene,
      {.ert = volume.options.ert, .filter_weight_error = device.filter_weight_error(path)});
  return reference::render_volume(volume.scene, model).bound_image();
}

TEST(Adapt, ImagesStayWithinTheBudget) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        for (const bool shaded : {false, true}) {
          for (const double adapt : {1.0 / 4096, 1.0 / 255, 1.0 / 8}) {
            SCOPED_TRACE(std::string(generator.name) + " " + std::string(function) +
                         (shaded ? " shaded " : " ") + std::to_string(adapt));
            scene::VolumeScene scene = small_scene(function);
            scene.shading.enabled = shaded;
            measure::Work work = generated(device, generator.name, std::move(scene));
            options_of(work).adapt = adapt;
            expect_within_bound(device, work);
          }
        }
      }
    }
  });
}

// Compares images with and without merging from the same device. They may differ by no more than
// the budget plus the round-off of both images.
TEST(Adapt, ImagesOfOneDeviceDifferByAtMostTheBudget) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const double adapt : {1.0 / 255, 1.0 / 8}) {
        SCOPED_TRACE(std::string(generator.name) + " " + std::to_string(adapt));
        measure::Work work = generated(device, generator.name, small_scene("haze"));
        options_of(work).ert = 0;
        const core::Image without = draw(device, work);
        options_of(work).adapt = adapt;
        const core::Image merged = draw(device, work);
        const core::Image bound = bound_without_budget(device, work);
        for (std::size_t i = 0; i < merged.rgba.size(); ++i) {
          const double rounding = 2 * static_cast<double>(bound.rgba[i]);
          ASSERT_NEAR(merged.rgba[i], without.rgba[i], adapt + rounding) << i;
        }
      }
    }
  });
}

TEST(Adapt, TakesFewerSamplesAndCountsTheSavedOnes) {
  on_every_driver([](measure::Device& device) {
    for (const std::string_view name : {"uniform_box", "mandelbulb"}) {
      SCOPED_TRACE(name);
      measure::Work work = generated(device, name, small_scene("haze"));
      options_of(work).ert = 0;
      const record::Counts without = counts_of(device, work);
      options_of(work).adapt = 1.0 / 255;
      const record::Counts merged = counts_of(device, work);
      EXPECT_LT(merged.at("samples"), without.at("samples"));
      EXPECT_EQ(merged.at("samples") + merged.at("samples_saved"),
                without.at("samples") + without.at("samples_saved"));
      EXPECT_EQ(merged.at("rays_hit"), without.at("rays_hit"));
      EXPECT_EQ(merged.at("bricks_skipped"), without.at("bricks_skipped"));
    }
  });
}

// In a homogeneous box, merging adds no error whatever the budget is, so the bound only contains
// round-off.
TEST(Adapt, V1IsExactWithOneSamplePerRay) {
  on_every_driver([](measure::Device& device) {
    for (const double step : {0.125, 0.3, 1.0, 7.7}) {
      SCOPED_TRACE(step);
      reference::AnalyticOptions size;
      size.size = {24, 24, 24};
      size.step_voxels = step;
      const reference::AnalyticScene analytic =
          analytic_scene(reference::AnalyticProblem::v1_constant, size);
      const technique::Sampler sampler = device.default_path({scene::VoxelFormat::f32}).sampler;
      const measure::Work work =
          walking({.technique = "raycast",
                   .scene = VolumeWork{.scene = analytic.scene,
                                       .options = {.sampler = sampler, .ert = 0, .adapt = 1e-9}}});
      const record::Counts counts = counts_of(device, work);
      // A ray may take two samples: the middle of its last step may lie outside of the box, where
      // there are no bricks, so this step is not merged with the others.
      EXPECT_LE(counts.at("samples"), 2 * counts.at("rays_hit"));
      expect_closed_form(device, work, analytic);
    }
  });
}

TEST(Adapt, OtherSkipModesAreRejectedWithAReason) {
  on_every_driver([](measure::Device& device) {
    measure::Work work = generated(device, "uniform_box", small_scene("haze"));
    options_of(work).adapt = 1e-3;
    EXPECT_FALSE(device.unsupported(work));
    options_of(work).skip = technique::Skip::distance;
    EXPECT_TRUE(device.unsupported(work));
  });
}

TEST(Adapt, RealVolumesStayWithinTheBudget) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_driver([&](measure::Device& device) {
    for (const auto& file : files) {
      SCOPED_TRACE(file.filename().string());
      measure::Work work =
          walking(default_work(device, scene::load_volume(file.string()), small_scene("haze")));
      options_of(work).adapt = 1.0 / 255;
      expect_within_bound(device, work);
    }
  });
}

}  // namespace
}  // namespace triptych::contract
