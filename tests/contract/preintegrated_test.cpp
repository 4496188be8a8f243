// Tests the quadrature `preintegrated` on real devices. It is exact if the field is linear along
// every step, of second order elsewhere, and within its bound everywhere.

#include <algorithm>
#include <cmath>

#include "reference/analytic_scenes.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;
using reference::AnalyticProblem;

reference::AnalyticScene preintegrated_scene(AnalyticProblem problem, int size, double step) {
  reference::AnalyticOptions options;
  options.size = {size, size, size};
  options.step_voxels = step;
  reference::AnalyticScene analytic = analytic_scene(problem, options);
  analytic.scene.quadrature = scene::Quadrature::preintegrated;
  return analytic;
}

measure::Work preintegrated_work(const measure::Device& device, const scene::VolumeScene& scene) {
  return {.technique = "raycast",
          .scene = VolumeWork{
              .scene = scene,
              .options = {.sampler = device.default_path({scene::VoxelFormat::f32}).sampler,
                          .ert = 0}}};
}

double rms_error(const core::Image& image, const reference::AnalyticScene& analytic) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto exact = analytic.exact(x, y).rgba;
      for (std::size_t c = 0; c < 4; ++c) sum += std::pow(image.pixel(x, y)[c] - exact[c], 2);
    }
  }
  return std::sqrt(sum / (4.0 * static_cast<double>(image.pixel_count())));
}

// The remaining error consists of two parts. The first is the round-off in positions, values and
// sums. Its root mean square is 1.3e-7, as in problem V1 (a homogeneous box), which has no other
// error. The second is the error of the table between two entries, which is derived in
// analytic_scenes.hpp and amounts to 1e-6 for the worst pixel. The midpoint rule with the same step
// size has an error of 1e-4 or more.
TEST(Preintegrated, V3IsExactForEveryStepUpToItsPlateaus) {
  on_every_driver([](measure::Device& device) {
    for (const double step : {0.125, 0.3, 0.5, 1.0}) {
      const reference::AnalyticScene analytic =
          preintegrated_scene(AnalyticProblem::v3_plateaus, 8, step);
      const double error =
          rms_error(draw(device, preintegrated_work(device, analytic.scene)), analytic);
      EXPECT_LT(error, 3e-7) << "step " << step;
    }
    reference::AnalyticScene midpoint = preintegrated_scene(AnalyticProblem::v3_plateaus, 8, 1);
    midpoint.scene.quadrature = scene::Quadrature::midpoint;
    EXPECT_GT(rms_error(draw(device, preintegrated_work(device, midpoint.scene)), midpoint), 1e-4);
  });
}

TEST(Preintegrated, V1IsExactForEveryStep) {
  on_every_driver([](measure::Device& device) {
    for (const double step : {0.125, 0.3, 1.0, 7.7, 100.0}) {
      const reference::AnalyticScene analytic =
          preintegrated_scene(AnalyticProblem::v1_constant, 16, step);
      EXPECT_LT(rms_error(draw(device, preintegrated_work(device, analytic.scene)), analytic), 3e-7)
          << "step " << step;
    }
  });
}

TEST(Preintegrated, SmoothProblemsAreOfSecondOrder) {
  on_every_driver([](measure::Device& device) {
    for (const AnalyticProblem problem :
         {AnalyticProblem::v2_ramp, AnalyticProblem::v3_segment, AnalyticProblem::v5_atmosphere}) {
      const auto error = [&](double step) {
        const reference::AnalyticScene analytic = preintegrated_scene(problem, 10, step);
        return rms_error(draw(device, preintegrated_work(device, analytic.scene)), analytic);
      };
      EXPECT_GE(std::log2(error(1) / error(0.125)) / 3, 1.9) << reference::name_of(problem);
    }
  });
}

TEST(Preintegrated, StaysWithinItsBound) {
  on_every_driver([](measure::Device& device) {
    for (const char* data : {"mandelbulb", "marschner_lobb", "sparse_field"}) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        for (const bool shaded : {false, true}) {
          for (const double step : {0.5, 1.7}) {
            SCOPED_TRACE(std::string(data) + " " + std::string(function));
            scene::VolumeScene scene = small_scene(function);
            scene.quadrature = scene::Quadrature::preintegrated;
            scene.shading.enabled = shaded;
            scene.step_voxels = step;
            expect_within_bound(
                device,
                default_work(device, scene::generate_volume(data, {40, 40, 40}), std::move(scene)));
          }
        }
      }
    }
  });
}

// Long steps are split at whole cells of the table. Without that, these steps had errors of up to
// 0.3, which exceeded their bound.
TEST(Preintegrated, OpaqueStepsAreExact) {
  on_every_driver([](measure::Device& device) {
    for (const double step : {2.0, 64.0}) {
      scene::VolumeScene scene = small_scene("surfaces");
      scene.quadrature = scene::Quadrature::preintegrated;
      scene.step_voxels = step;
      measure::Work work = default_work(
          device, scene::generate_volume("marschner_lobb", {40, 40, 40}), std::move(scene));
      auto& volume = std::get<VolumeWork>(work.scene);
      volume.options.ert = 0;
      expect_within_bound(device, work);
      const core::Image truth = reference::render_volume(volume.scene).image();
      const core::Image image = draw(device, work);
      double largest = 0;
      for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
        largest = std::max(largest, std::abs(static_cast<double>(image.rgba[i] - truth.rgba[i])));
      }
      EXPECT_LT(largest, 3e-5) << "step " << step;
    }
  });
}

// Uses a table with an opacity of 1, with jumps, and with a peak that is one entry wide.
TEST(Preintegrated, SteepTransferFunctionsStayWithinTheBound) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = small_scene("haze");
    scene.quadrature = scene::Quadrature::preintegrated;
    auto& entries = scene.transfer_function.entries;
    entries[60] = {1, 0, 0, 0.9F};
    for (std::size_t k = 180; k < 200; ++k) entries[k] = {0, 1, 0, 1};
    expect_within_bound(
        device,
        default_work(device, scene::generate_volume("mandelbulb", {40, 40, 40}), std::move(scene)));
  });
}

TEST(Preintegrated, SpeedOfLightRejectsIt) {
  on_every_driver([](measure::Device& device) {
    measure::Work work =
        preintegrated_work(device, preintegrated_scene(AnalyticProblem::v1_constant, 8, 1).scene);
    work.technique = "speed_of_light";
    EXPECT_NE(device.unsupported(work), std::nullopt);
  });
}

}  // namespace
}  // namespace triptych::contract
