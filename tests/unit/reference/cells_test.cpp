// Tests the quadrature `cells` in double precision: it is exact where field and table are linear,
// and converges with fourth order elsewhere, even for sharp transfer functions.

#include <gtest/gtest.h>

#include <cmath>

#include "reference/analytic_scenes.hpp"
#include "reference/volume.hpp"
#include "scene/camera.hpp"
#include "scene/generators.hpp"

namespace triptych::reference {
namespace {

scene::VolumeScene volume_scene_of(std::string_view data, std::string_view function) {
  scene::VolumeScene scene{
      .grid = std::make_shared<const scene::VoxelGrid>(
          scene::encode(scene::generate_volume(data, {24, 24, 24}), scene::VoxelFormat::f32)),
      .transfer_function = scene::load_transfer_function(function),
      .width = 24,
      .height = 24,
      .quadrature = scene::Quadrature::cells,
  };
  scene.camera = scene::camera_at("orbit_y:1/9", scene.box(), 60);
  return scene;
}

double rms(const Truth& a, const Truth& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::pow(a.rgba[i] - b.rgba[i], 2);
  return std::sqrt(sum / static_cast<double>(a.rgba.size()));
}

TEST(CellsImage, ConvergesToTheLimitOfTheMidpointRule) {
  for (const char* function : {"haze", "surfaces"}) {
    scene::VolumeScene scene = volume_scene_of("mandelbulb", function);
    const Truth limit = render_volume_converged(scene, 1e-6);
    scene.step_voxels = 1.0 / 16;
    EXPECT_LT(rms(render_volume(scene), limit), 1e-6) << function;
  }
}

// Returns a table in which opacity and red rise linearly up to the ridge and fall linearly after
// it.
scene::TransferFunction tent_function(double ridge) {
  scene::TransferFunction function;
  for (std::size_t k = 0; k < 256; ++k) {
    const auto x = static_cast<float>(1 - std::abs(static_cast<double>(k) - ridge) / 256);
    function.entries[k] = {x, 1 - x, 0.5F, 0.5F * x};
  }
  return function;
}

double order_of(std::string_view data, double ridge) {
  scene::VolumeScene scene = volume_scene_of(data, "haze");
  scene.transfer_function = tent_function(ridge);
  scene.step_voxels = 1.0 / 32;
  const Truth limit = render_volume(scene);
  scene.step_voxels = 1;
  const double coarse = rms(render_volume(scene), limit);
  scene.step_voxels = 1.0 / 4;
  return std::log2(coarse / rms(render_volume(scene), limit)) / 2;
}

// Somewhere in the volume is a surface on which the field has the value of the table's ridge. On
// rays that are tangent to that surface, the error behaves like the square root of a distance,
// which makes the order slightly lower than four.
TEST(CellsImage, IsOfFourthOrder) {
  for (const char* data : {"gaussian_blob", "marschner_lobb"}) {
    EXPECT_GE(order_of(data, 255), 3.9) << data << ", which no kink meets";
    EXPECT_GE(order_of(data, 128), 3.4) << data;
  }
}

// Steps longer than a cell do not subdivide any cell.
TEST(CellsImage, IsTheSameForAllStepsLongerThanACell) {
  scene::VolumeScene scene = volume_scene_of("mandelbulb", "haze");
  const Truth one = render_volume(scene);
  scene.step_voxels = 7;
  EXPECT_EQ(render_volume(scene).rgba, one.rgba);
}

TEST(CellsImage, OfOneValueIsExact) {
  AnalyticOptions options;
  options.size = {8, 8, 8};
  AnalyticScene analytic = analytic_scene(AnalyticProblem::v1_constant, options);
  analytic.scene.quadrature = scene::Quadrature::cells;
  const Truth truth = render_volume(analytic.scene);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      for (std::size_t c = 0; c < 4; ++c) {
        const auto i = static_cast<std::size_t>(4 * (y * truth.width + x)) + c;
        EXPECT_NEAR(truth.rgba[i], analytic.exact(x, y).rgba[c], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace triptych::reference
