// Tests the problems V1–V7 and V9 (reference/analytic_scenes.hpp) on real devices: the images
// converge to the closed-form solutions with the expected order of the quadrature.

#include <algorithm>
#include <cmath>

#include "reference/analytic_scenes.hpp"
#include "reference/volume.hpp"
#include "suites/volume/tolerance.hpp"
#include "tests/support/fitted_order.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using reference::AnalyticProblem;

const std::vector<double> steps{1, 0.5, 0.25, 0.125};

reference::AnalyticScene scene_of(AnalyticProblem problem, int size, double step) {
  reference::AnalyticOptions options;
  options.size = {size, size, size};
  options.step_voxels = step;
  return analytic_scene(problem, options);
}

measure::Work work_of(const measure::Device& device, const scene::VolumeScene& scene) {
  return {.technique = "raycast",
          .scene = measure::VolumeWork{
              .scene = scene,
              .options = {.sampler = device.default_path({scene::VoxelFormat::f32}).sampler,
                          .ert = 0}}};
}

// Returns the root mean square of the difference from `exact(x, y)` over all pixels and channels.
template <class Exact>
double rms_error(const core::Image& image, const Exact& exact) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto truth = exact(x, y);
      for (std::size_t c = 0; c < 4; ++c) sum += std::pow(image.pixel(x, y)[c] - truth[c], 2);
    }
  }
  return std::sqrt(sum / (4.0 * static_cast<double>(image.pixel_count())));
}

double order_on(measure::Device& device, AnalyticProblem problem, int size) {
  std::vector<double> errors;
  for (const double step : steps) {
    const reference::AnalyticScene analytic = scene_of(problem, size, step);
    const core::Image image = draw(device, work_of(device, analytic.scene));
    errors.push_back(rms_error(image, [&](int x, int y) { return analytic.exact(x, y).rgba; }));
  }
  return test::fitted_order(steps, errors);
}

TEST(Orders, V1IsExactForEveryStepSize) {
  on_every_driver([](measure::Device& device) {
    for (const double step : {0.125, 0.3, 1.0, 2.0, 7.7, 100.0}) {
      SCOPED_TRACE(step);
      const reference::AnalyticScene analytic = scene_of(AnalyticProblem::v1_constant, 16, step);
      expect_closed_form(device, work_of(device, analytic.scene), analytic);
    }
  });
}

TEST(Orders, SmoothProblemsAreOfSecondOrder) {
  on_every_driver([](measure::Device& device) {
    for (const AnalyticProblem problem :
         {AnalyticProblem::v2_ramp, AnalyticProblem::v3_segment, AnalyticProblem::v5_atmosphere}) {
      EXPECT_GE(order_on(device, problem, 10), 1.9) << reference::name_of(problem);
    }
  });
}

// Returns the order with which images converge to the limit image, which is the image of the voxel
// grid with exact ray integrals. Used for scenes whose grid only approximates the field of the
// closed-form solution.
double order_against_limit(measure::Device& device, AnalyticProblem problem, int size) {
  reference::AnalyticScene analytic = scene_of(problem, size, 1);
  const core::Image exact = reference::render_volume_converged(analytic.scene, 1e-7).image();
  std::vector<double> errors;
  for (const double step : steps) {
    analytic.scene.step_voxels = step;
    errors.push_back(rms_error(draw(device, work_of(device, analytic.scene)),
                               [&](int x, int y) { return exact.pixel(x, y); }));
  }
  return test::fitted_order(steps, errors);
}

TEST(Orders, V4IsOfSecondOrder) {
  on_every_driver([](measure::Device& device) {
    EXPECT_GE(order_against_limit(device, AnalyticProblem::v4_gaussian, 24), 1.9);
  });
}

TEST(Orders, V7IsLimitedByItsFaces) {
  on_every_driver([](measure::Device& device) {
    const double order = order_against_limit(device, AnalyticProblem::v7_shell, 24);
    EXPECT_GT(order, 0.4);
    EXPECT_LT(order, 1.8);
  });
}

// Compares the shaded image of a device with the closed-form solution for the true gradient of the
// wave. The error has three parts: the device's round-off; the difference between the image for
// this step size and the image in the limit of small steps; and the difference between that limit,
// whose gradients are central differences on a grid, and the closed-form solution.
double wave_error_on(measure::Device& device, int size) {
  const reference::AnalyticScene analytic = scene_of(AnalyticProblem::v9_wave, size, 0.25);
  constexpr double tolerance = 1e-7;
  const core::Image image = draw(device, work_of(device, analytic.scene));
  const core::Image limit = reference::render_volume_converged(analytic.scene, tolerance).image();
  const reference::Truth truth =
      reference::render_volume(analytic.scene, volume_suite::error_model(analytic.scene, {}));
  const core::Image lattice = truth.image();
  const core::Image bound = truth.bound_image();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto exact = analytic.exact(x, y);
      for (std::size_t c = 0; c < 4; ++c) {
        const auto step =
            static_cast<double>(std::abs(lattice.pixel(x, y)[c] - limit.pixel(x, y)[c]));
        EXPECT_NEAR(
            image.pixel(x, y)[c], exact.rgba[c],
            exact.model_error + step + tolerance + static_cast<double>(bound.pixel(x, y)[c]))
            << x << ' ' << y;
      }
    }
  }
  return rms_error(image, [&](int x, int y) { return analytic.exact(x, y).rgba; });
}

TEST(Orders, V9GradientIsOfSecondOrderInVoxelSize) {
  on_every_driver([](measure::Device& device) {
    std::vector<double> spacings;
    std::vector<double> errors;
    for (const int size : {8, 16, 32}) {
      spacings.push_back(1.0 / size);
      errors.push_back(wave_error_on(device, size));
    }
    EXPECT_GE(test::fitted_order(spacings, errors), 1.9);
  });
}

TEST(Orders, V6IsLimitedByItsEdge) {
  on_every_driver([](measure::Device& device) {
    const double order = order_on(device, AnalyticProblem::v6_layers, 12);
    EXPECT_GT(order, 0.4);
    EXPECT_LT(order, 1.8);
  });
}

}  // namespace
}  // namespace triptych::contract
