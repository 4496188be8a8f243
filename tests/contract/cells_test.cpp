// Tests the quadrature `cells`, which integrates each voxel cell along the ray, on real devices. It
// is exact for a homogeneous box, stays within its error bound everywhere, gives bit-identical
// images for all modes of skipping empty space, and is closer to the limit image (the exact
// integral) than the midpoint rule with an eighth of its step size.

#include <algorithm>
#include <cmath>

#include "data_folder.hpp"
#include "reference/analytic_scenes.hpp"
#include "under_test.hpp"
#include "volume_truth.hpp"

namespace triptych::contract {
namespace {

using measure::VolumeWork;
using reference::AnalyticProblem;
using technique::Skip;

scene::VolumeScene cells_scene(std::string_view function) {
  scene::VolumeScene scene = small_scene(function);
  scene.quadrature = scene::Quadrature::cells;
  return scene;
}

measure::Work cells_work(const scene::Volume& data, scene::VolumeScene scene) {
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::Volume(data), scene::lossless_format(data.type)));
  scene.camera = scene::camera_at("orbit_y:1/8", scene.box(), 60);
  return {.technique = "raycast",
          .scene = VolumeWork{.scene = std::move(scene),
                              .options = {.sampler = technique::Sampler::manual}}};
}

double rms_from(const core::Image& image, const reference::Truth& limit) {
  double sum = 0;
  for (std::size_t i = 0; i < limit.rgba.size(); ++i) {
    sum += std::pow(static_cast<double>(image.rgba[i]) - limit.rgba[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(limit.rgba.size()));
}

TEST(Cells, StayWithinTheirBound) {
  on_every_driver([](measure::Device& device) {
    for (const char* data : {"mandelbulb", "marschner_lobb", "sparse_field", "uniform_box"}) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        for (const bool shaded : {false, true}) {
          for (const double step : {0.5, 1.0}) {
            SCOPED_TRACE(std::string(data) + " " + std::string(function));
            scene::VolumeScene scene = cells_scene(function);
            scene.shading.enabled = shaded;
            scene.step_voxels = step;
            expect_within_bound(device,
                                cells_work(scene::generate_volume(data, {40, 33, 27}), scene));
          }
        }
      }
    }
  });
}

// Uses a table with an opacity of 1, with jumps, and with a peak that is one entry wide.
TEST(Cells, SteepTransferFunctionsStayWithinTheBound) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = cells_scene("haze");
    auto& entries = scene.transfer_function.entries;
    entries[60] = {1, 0, 0, 0.9F};
    for (std::size_t k = 180; k < 200; ++k) entries[k] = {0, 1, 0, 1};
    expect_within_bound(device,
                        cells_work(scene::generate_volume("mandelbulb", {40, 40, 40}), scene));
  });
}

TEST(Cells, SkippingIsBitIdentical) {
  on_every_driver([](measure::Device& device) {
    for (const scene::GeneratorInfo& generator : scene::volume_generators()) {
      for (const std::string_view function : scene::transfer_function_presets()) {
        for (const char* technique : {"raycast", "raycast_fragment"}) {
          SCOPED_TRACE(std::string(generator.name) + " " + std::string(function));
          measure::Work work = cells_work(scene::generate_volume(generator.name, {37, 41, 23}),
                                          cells_scene(function));
          work.technique = technique;
          if (device.unsupported(work)) continue;
          auto& options = std::get<VolumeWork>(work.scene).options;
          options.skip = Skip::none;
          const core::Image without = draw(device, work);
          for (const Skip skip : {Skip::bricks, Skip::distance}) {
            options.skip = skip;
            EXPECT_EQ(draw(device, work), without) << technique::name_of(skip);
          }
        }
      }
    }
  });
}

TEST(Cells, RealVolumesStayWithinTheBoundAndAreBitIdentical) {
  const auto files = real_volumes();
  if (files.empty()) GTEST_SKIP() << "TRIPTYCH_DATA names no folder with volumes/";
  on_every_driver([&](measure::Device& device) {
    for (const auto& file : files) {
      SCOPED_TRACE(file.filename().string());
      measure::Work work = cells_work(scene::load_volume(file.string()), cells_scene("surfaces"));
      expect_within_bound(device, work);
      auto& options = std::get<VolumeWork>(work.scene).options;
      const core::Image leaping = draw(device, work);
      options.skip = Skip::none;
      EXPECT_EQ(draw(device, work), leaping);
    }
  });
}

// In V1, a homogeneous box, the field has a single value, so each cell is a single piece with a
// constant integrand. Only round-off remains.
TEST(Cells, V1IsExact) {
  on_every_driver([](measure::Device& device) {
    reference::AnalyticOptions options;
    options.size = {16, 16, 16};
    reference::AnalyticScene analytic = analytic_scene(AnalyticProblem::v1_constant, options);
    analytic.scene.quadrature = scene::Quadrature::cells;
    expect_closed_form(
        device,
        {.technique = "raycast",
         .scene = VolumeWork{.scene = analytic.scene,
                             .options = {.sampler = technique::Sampler::manual, .ert = 0}}},
        analytic);
  });
}

// To be as accurate as the quadrature `cells`, a second-order rule such as the midpoint rule would
// need a step size of about one hundredth of a voxel.
TEST(Cells, AreCloserToTheLimitThanManySamples) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = cells_scene("surfaces");
    measure::Work work = cells_work(scene::generate_volume("mandelbulb", {40, 40, 40}), scene);
    auto& volume = std::get<VolumeWork>(work.scene);
    volume.options.ert = 0;
    volume.scene.step_voxels = 1;
    const reference::Truth limit = reference::render_volume_converged(volume.scene, 1e-7);
    const double cells = rms_from(draw(device, work), limit);
    const auto nonzero = device.prepare(work)->frame(measure::Purpose::counters).counts;
    volume.scene.quadrature = scene::Quadrature::midpoint;
    volume.scene.step_voxels = 0.125;
    const double midpoint = rms_from(draw(device, work), limit);
    const auto samples = device.prepare(work)->frame(measure::Purpose::counters).counts;
    EXPECT_LT(cells, midpoint / 2);
    EXPECT_LT(nonzero.at("samples"), samples.at("samples"));
  });
}

// llvmpipe and lavapipe from Mesa 22.3 silently end all loops of a shader invocation after 65,535
// iterations. In this scene, each ray consists of many shaded pieces (the parts of the ray that are
// integrated one by one), and the shader used to compute the highlight of each piece with a loop.
// Rays therefore ended too early. The error bound of a shaded image is too wide to reveal such
// rays, so this test limits the RMS difference from the reference image instead.
TEST(Cells, AllOfManyShadedPiecesAreDrawn) {
  on_every_driver([](measure::Device& device) {
    scene::VolumeScene scene = cells_scene("haze");
    scene.shading.enabled = true;
    scene.width = scene.height = 4;
    scene.step_voxels = 1.0 / 64;
    measure::Work work = cells_work(scene::generate_volume("gradient_box", {64, 64, 64}), scene);
    auto& volume = std::get<VolumeWork>(work.scene);
    volume.options.ert = 0;
    const reference::Truth truth = reference::render_volume(volume.scene);
    for (const std::string_view technique : {"raycast", "raycast_fragment"}) {
      work.technique = technique;
      if (device.unsupported(work)) continue;
      EXPECT_LT(rms_from(draw(device, work), truth), 1e-4) << technique;
    }
  });
}

TEST(Cells, AreRejectedWhereTheyCannotBeDrawn) {
  on_every_driver([](measure::Device& device) {
    const measure::Work work =
        cells_work(scene::generate_volume("uniform_box", {8, 8, 8}), cells_scene("haze"));
    const auto refused = [&](auto change) {
      measure::Work changed = work;
      change(changed, std::get<VolumeWork>(changed.scene));
      return device.unsupported(changed).has_value();
    };
    EXPECT_FALSE(refused([](auto&, auto&) {}));
    EXPECT_TRUE(refused([](auto& each, auto&) { each.technique = "speed_of_light"; }));
    EXPECT_TRUE(refused(
        [](auto&, auto& volume) { volume.options.sampler = technique::Sampler::hardware; }));
    EXPECT_TRUE(refused(
        [](auto&, auto& volume) { volume.options.precision = technique::Precision::fp64; }));
    EXPECT_TRUE(refused([](auto&, auto& volume) {
      volume.options.skip = Skip::bricks;
      volume.options.adapt = 0.01;
    }));
  });
}

}  // namespace
}  // namespace triptych::contract
