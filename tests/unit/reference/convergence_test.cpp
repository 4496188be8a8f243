// Compares the renderer with closed-form solutions. It must converge with the order of the midpoint
// rule.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/analytic_scenes.hpp"
#include "reference/volume.hpp"
#include "tests/support/fitted_order.hpp"

namespace triptych::reference {
namespace {

struct Difference {
  double rms = 0;
  double largest = 0;
  // The largest amount by which the error of a pixel exceeds AnalyticPixel::model_error, the part
  // that is due to the finite grid and table.
  double excess = 0;
};

Difference difference(const AnalyticScene& analytic, const Truth& truth) {
  Difference d;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const AnalyticPixel exact = analytic.exact(x, y);
      const auto pixel = static_cast<std::size_t>(y * truth.width + x);
      for (std::size_t i = 0; i < 4; ++i) {
        const double error = std::abs(truth.rgba[4 * pixel + i] - exact.rgba[i]);
        d.rms += error * error;
        d.largest = std::max(d.largest, error);
        d.excess = std::max(d.excess, error - exact.model_error);
      }
    }
  }
  d.rms = std::sqrt(d.rms / (4.0 * truth.width * truth.height));
  return d;
}

AnalyticOptions options(int size, double step = 1) {
  AnalyticOptions o;
  o.size = {size, size, size};
  o.width = o.height = 24;
  o.step_voxels = step;
  return o;
}

const std::vector<double> halvings{1, 0.5, 0.25, 0.125};
const std::vector<double> more_halvings{1, 0.5, 0.25, 0.125, 0.0625};

double order_against_closed_form(AnalyticProblem problem, int size) {
  std::vector<double> errors;
  for (const double step : halvings) {
    const AnalyticScene analytic = analytic_scene(problem, options(size, step));
    errors.push_back(difference(analytic, render_volume(analytic.scene)).rms);
  }
  return test::fitted_order(halvings, errors);
}

TEST(Convergence, ConstantMediumIsExactForEveryStep) {
  for (const double step : {0.0625, 0.3, 1.0, 2.0, 7.7, 1e3}) {
    AnalyticOptions o = options(16, step);
    o.background = {0.25F, 0.5F, 0.125F, 1.0F};
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v1_constant, o);
    EXPECT_LT(difference(analytic, render_volume(analytic.scene)).largest, 1e-12) << step;
  }
}

TEST(Convergence, ConstantMediumIsExactForAnySpacing) {
  AnalyticOptions o = options(8, 0.7);
  o.size = {5, 9, 13};
  o.spacing = {1, 8, 0.25};
  const AnalyticScene analytic = analytic_scene(AnalyticProblem::v1_constant, o);
  EXPECT_LT(difference(analytic, render_volume(analytic.scene)).largest, 1e-12);
}

TEST(Convergence, SmoothProblemsAreOfSecondOrder) {
  EXPECT_GE(order_against_closed_form(AnalyticProblem::v2_ramp, 10), 1.9);
  EXPECT_GE(order_against_closed_form(AnalyticProblem::v3_segment, 10), 1.9);
  EXPECT_GE(order_against_closed_form(AnalyticProblem::v5_atmosphere, 10), 1.9);
  EXPECT_GE(order_against_closed_form(AnalyticProblem::v8_trilinear, 10), 1.9);
}

double order_against_limit(AnalyticProblem problem, int size, const std::vector<double>& steps) {
  const AnalyticScene analytic = analytic_scene(problem, options(size));
  const Truth limit = render_volume_converged(analytic.scene, 1e-8);
  std::vector<double> errors;
  for (const double step : steps) {
    scene::VolumeScene scene = analytic.scene;
    scene.step_voxels = step;
    const Truth truth = render_volume(scene);
    double sum = 0;
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
      sum += std::pow(truth.rgba[i] - limit.rgba[i], 2);
    }
    errors.push_back(std::sqrt(sum));
  }
  return test::fitted_order(steps, errors);
}

// The voxel grid only approximates the blob, so the errors for different step sizes are measured
// against the limit image of the grid, to which images converge for small steps. The series ends
// with an additional, smaller step, because the kinks at cell boundaries of a smooth field dominate
// the error only at small steps.
TEST(Convergence, BlobIsOfSecondOrderInTheStep) {
  EXPECT_GE(order_against_limit(AnalyticProblem::v4_gaussian, 24, more_halvings), 1.9);
}

TEST(Convergence, BlobIsOfSecondOrderInTheVoxelSize) {
  std::vector<double> sizes;
  std::vector<double> errors;
  for (const int size : {20, 40, 80}) {
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v4_gaussian, options(size, 0.5));
    sizes.push_back(1.0 / size);
    errors.push_back(difference(analytic, render_volume(analytic.scene)).rms);
  }
  EXPECT_GE(test::fitted_order(sizes, errors), 1.9);
}

TEST(Convergence, AWaveIsOfSecondOrderInTheVoxelSize) {
  std::vector<double> sizes;
  std::vector<double> errors;
  for (const int size : {16, 32, 64}) {
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v9_wave, options(size));
    sizes.push_back(1.0 / size);
    errors.push_back(difference(analytic, render_volume_converged(analytic.scene, 1e-7)).rms);
  }
  EXPECT_GE(test::fitted_order(sizes, errors), 1.95);
}

TEST(Convergence, LayersAreLimitedByTheirEdge) {
  const double order = order_against_closed_form(AnalyticProblem::v6_layers, 12);
  EXPECT_GT(order, 0.4);
  EXPECT_LT(order, 1.7);
}

// Compares with the limit image of the grid itself, which differs from the closed-form solution.
TEST(Convergence, AShellIsLimitedByItsFaces) {
  const double order = order_against_limit(AnalyticProblem::v7_shell, 24, halvings);
  EXPECT_GT(order, 0.4);
  EXPECT_LT(order, 1.7);
}

// Compares limit images for rays that cross the faces of the shell steeply. The remaining error
// comes from interpolating the distance from the centre, which the grid stores. The ramps in the
// table hardly contribute, because they are symmetric about the faces.
TEST(Convergence, AShellIsOfSecondOrderInTheVoxelSize) {
  std::vector<double> sizes;
  std::vector<double> errors;
  for (const int size : {16, 32, 64}) {
    AnalyticOptions o = options(size);
    o.camera = analytic_scene(AnalyticProblem::v7_shell, o).scene.camera;
    o.camera->fov_y_deg = 12;
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v7_shell, o);
    sizes.push_back(1.0 / size);
    errors.push_back(difference(analytic, render_volume_converged(analytic.scene, 1e-6)).rms);
  }
  EXPECT_GE(test::fitted_order(sizes, errors), 1.8);
}

TEST(Convergence, LayersSeenFromBehindAreReversed) {
  AnalyticOptions o = options(12, 0.125);
  o.width = o.height = 1;
  o.camera = scene::Camera{.eye = {6, 6, 40}, .forward = {0, 0, -1}, .up = {0, 1, 0}};
  const AnalyticPixel front = analytic_scene(AnalyticProblem::v6_layers, o).exact(0, 0);
  o.camera = scene::Camera{.eye = {6, 6, -28}, .forward = {0, 0, 1}, .up = {0, 1, 0}};
  const AnalyticScene reversed = analytic_scene(AnalyticProblem::v6_layers, o);
  EXPECT_NEAR(front.rgba[3], reversed.exact(0, 0).rgba[3], 1e-15);
  EXPECT_GT(std::abs(front.rgba[0] - reversed.exact(0, 0).rgba[0]), 0.1);
  EXPECT_LT(difference(reversed, render_volume(reversed.scene)).largest, 2e-3);
}

// The limit image must equal the closed-form solution, apart from what the grid and the table
// cannot represent.
TEST(Convergence, LimitMatchesTheClosedForm) {
  for (const AnalyticProblem problem : analytic_problems) {
    for (const int size : {8, 32}) {
      const AnalyticScene analytic = analytic_scene(problem, options(size));
      const double tolerance = 1e-7;
      const Truth limit = render_volume_converged(analytic.scene, tolerance);
      EXPECT_LE(*std::max_element(limit.bound.begin(), limit.bound.end()), tolerance)
          << name_of(problem);
      EXPECT_LT(difference(analytic, limit).excess, tolerance) << name_of(problem) << ' ' << size;
    }
  }
}

TEST(Convergence, ModelErrorIsSmallWhereTheGridIsTheClosedForm) {
  for (const AnalyticProblem problem :
       {AnalyticProblem::v2_ramp, AnalyticProblem::v3_segment, AnalyticProblem::v5_atmosphere}) {
    const AnalyticScene analytic = analytic_scene(problem, options(32));
    EXPECT_LT(analytic.exact(12, 12).model_error, 4e-5) << name_of(problem);
  }
}

TEST(Convergence, LimitAgreesWithAFineLattice) {
  const AnalyticScene analytic = analytic_scene(AnalyticProblem::v4_gaussian, options(10));
  scene::VolumeScene scene = analytic.scene;
  scene.shading.enabled = true;
  const Truth limit = render_volume_converged(scene, 1e-6);
  scene.step_voxels = 1.0 / 64;
  const Truth fine = render_volume(scene);
  for (std::size_t i = 0; i < fine.rgba.size(); ++i) {
    ASSERT_NEAR(fine.rgba[i], limit.rgba[i], 2e-4) << i;
  }
}

}  // namespace
}  // namespace triptych::reference
