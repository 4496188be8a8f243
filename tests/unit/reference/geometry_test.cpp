// Tests rays, boxes and fields at the limits of the supported range.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/error.hpp"
#include "random_scene.hpp"
#include "reference/analytic_scenes.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {
namespace {

double largest_difference_of_equal_sizes(const Truth& a, const Truth& b) {
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  }
  return largest;
}

ErrorModel some_model() {
  ErrorModel model;
  model.position_error_voxels = 1e-4;
  model.value_error = 1e-6;
  model.filter_weight_error = 1e-3;
  model.table_error = 1e-6;
  model.opacity_error = 1e-6;
  model.compositing_error = 1e-7;
  model.ert = 1e-3;
  return model;
}

TEST(Reference, SameBitsForAnyNumberOfThreads) {
  scene::VolumeScene scene = random_scene(1, Character::rough, scene::VoxelFormat::u8);
  scene.shading.enabled = true;
  const Truth single = render_volume(scene, some_model(), 1);
  const Truth limit =
      render_volume_converged(random_scene(1, Character::smooth, scene::VoxelFormat::u8), 1e-4, 1);
  for (const int threads : {0, 2, 3, 16, 100}) {
    const Truth threaded = render_volume(scene, some_model(), threads);
    EXPECT_EQ(single.rgba, threaded.rgba) << threads;
    EXPECT_EQ(single.bound, threaded.bound) << threads;
  }
  const Truth limit_of_many_threads =
      render_volume_converged(random_scene(1, Character::smooth, scene::VoxelFormat::u8), 1e-4, 5);
  EXPECT_EQ(limit.rgba, limit_of_many_threads.rgba);
  EXPECT_EQ(limit.bound, limit_of_many_threads.bound);
}

TEST(Reference, ReportsTheShareOfItsRows) {
  const scene::VolumeScene scene = random_scene(1, Character::smooth, scene::VoxelFormat::u8);
  std::vector<double> shares;
  const auto add = [&](double share) { shares.push_back(share); };
  static_cast<void>(render_volume(scene, some_model(), 1, add));
  ASSERT_EQ(shares.size(), static_cast<std::size_t>(scene.height) + 1);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  shares.clear();
  static_cast<void>(render_volume_converged(scene, 1e-4, 3, add));
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
}

TEST(Reference, AllOctantsMirrorEachOther) {
  const std::array<int, 3> size{7, 6, 5};
  const glm::dvec3 extent{7, 6, 5};
  const auto value = [](int i, int j, int k) { return ((3 * i + 5 * j + 7 * k) % 11) / 10.0; };
  const scene::VolumeScene base = random_scene(2, Character::smooth, scene::VoxelFormat::f32);
  const glm::dvec3 from{1.0, 0.8, 1.3};
  Truth first;
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<bool, 3> flip{(octant & 1) != 0, (octant & 2) != 0, (octant & 4) != 0};
    scene::VolumeScene scene = base;
    scene.shading.enabled = true;
    scene.width = 21;
    scene.height = 17;
    scene.grid = make_grid(size, {1, 1, 1}, scene::VoxelFormat::f32, [&](int i, int j, int k) {
      return value(flip[0] ? size[0] - 1 - i : i, flip[1] ? size[1] - 1 - j : j,
                   flip[2] ? size[2] - 1 - k : k);
    });
    const glm::dvec3 sign{flip[0] ? -1 : 1, flip[1] ? -1 : 1, flip[2] ? -1 : 1};
    scene.camera =
        look_at(0.5 * extent + 12.0 * sign * from, 0.5 * extent, sign * glm::dvec3{0, 1, 0});
    Truth truth = render_volume(scene);
    if (octant == 0) {
      first = truth;
      EXPECT_GT(first.rgba[4 * (8 * 21 + 10) + 3], 0.1);
      continue;
    }
    // An odd number of reflections swaps left and right in the image.
    if ((octant & 1) ^ ((octant >> 1) & 1) ^ (octant >> 2)) {
      for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width / 2; ++x) {
          for (int i = 0; i < 4; ++i) {
            const auto at = [&](int column) {
              return static_cast<std::size_t>(4 * (y * truth.width + column) + i);
            };
            std::swap(truth.rgba[at(x)], truth.rgba[at(truth.width - 1 - x)]);
          }
        }
      }
    }
    EXPECT_LT(largest_difference_of_equal_sizes(first, truth), 1e-9) << octant;
  }
}

scene::VolumeScene one_pixel(const glm::dvec3& eye, const glm::dvec3& forward,
                             const glm::dvec3& up = {0, 1, 0}) {
  scene::VolumeScene scene;
  scene.grid =
      make_grid({4, 5, 6}, {1, 1, 1}, scene::VoxelFormat::f32, [](int, int, int) { return 0.5; });
  scene.transfer_function = constant_table({1, 0.5F, 0.25F, 0.25F});
  scene.camera = scene::Camera{.eye = eye, .forward = forward, .up = up};
  scene.width = scene.height = 1;
  return scene;
}

double opacity_of(const scene::VolumeScene& scene) {
  return render_volume(scene).rgba[3];
}

TEST(Reference, RayInAFaceOrAlongAnEdgeSeesTheWholeLength) {
  const double exact = 1 - std::pow(0.75, 6);
  EXPECT_NEAR(opacity_of(one_pixel({0, 2, 20}, {0, 0, -1})), exact, 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({4, 2, 20}, {-0.0, 0, -1})), exact, 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({0, 5, 20}, {0, -0.0, -1})), exact, 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({4, 0, -3}, {0, 0, 1})), exact, 1e-14);
}

TEST(Reference, ParallelRayOutsideTheSlabMisses) {
  EXPECT_EQ(opacity_of(one_pixel({-1e-9, 2, 20}, {0, 0, -1})), 0.0);
  EXPECT_EQ(opacity_of(one_pixel({2, 5.0000001, 20}, {0, 0, -1})), 0.0);
}

TEST(Reference, EyeInsideSeesWhatIsAhead) {
  EXPECT_NEAR(opacity_of(one_pixel({2, 2, 4.5}, {0, 0, -1})), 1 - std::pow(0.75, 4.5), 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({2, 2, 6}, {0, 0, -1})), 1 - std::pow(0.75, 6), 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({2, 2, 0}, {0, 0, -1})), 0.0, 1e-14);
  EXPECT_NEAR(opacity_of(one_pixel({0, 0, 0}, {1, 0, 0})), 1 - std::pow(0.75, 4), 1e-14);
}

TEST(Reference, ObjectsBehindTheEyeAreInvisible) {
  EXPECT_EQ(opacity_of(one_pixel({2, 2, 20}, {0, 0, 1})), 0.0);
}

TEST(Reference, EyeInsideMatchesTheClosedFormEverywhere) {
  for (const glm::dvec3& eye : {glm::dvec3{4, 5, 6}, {0, 5, 6}, {0, 0, 6}, {12, 12, 12}}) {
    AnalyticOptions o;
    o.size = {12, 12, 12};
    o.step_voxels = 0.6;
    o.camera = look_at(eye, {6.1, 6.2, 2.3}, {0, 1, 0}, 120);
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v1_constant, o);
    const Truth truth = render_volume(analytic.scene);
    for (int y = 0; y < truth.height; ++y) {
      for (int x = 0; x < truth.width; ++x) {
        const auto pixel = static_cast<std::size_t>(4 * (y * truth.width + x));
        ASSERT_NEAR(truth.rgba[pixel + 3], analytic.exact(x, y).rgba[3], 1e-12);
      }
    }
  }
}

TEST(Reference, ZeroComponentIsTheLimitOfASmallOne) {
  scene::VolumeScene scene = random_scene(4, Character::smooth, scene::VoxelFormat::u16);
  const glm::dvec3 extent = scene.box().hi;
  scene.width = scene.height = 1;
  scene.camera =
      scene::Camera{.eye = {0.37 * extent.x, 0.61 * extent.y, 40}, .forward = {0, 0, -1}};
  const Truth straight = render_volume(scene);
  EXPECT_GT(straight.rgba[3], 0.05);
  scene.camera.forward = glm::dvec3{1e-9, -1e-9, -1};
  EXPECT_LT(largest_difference_of_equal_sizes(straight, render_volume(scene)), 1e-6);
}

TEST(Reference, OneVoxelIsABox) {
  AnalyticOptions o;
  o.size = {1, 1, 1};
  o.step_voxels = 0.3;
  const AnalyticScene analytic = analytic_scene(AnalyticProblem::v2_ramp, o);
  const Truth truth = render_volume(analytic.scene);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_NEAR(truth.rgba[static_cast<std::size_t>(4 * (y * truth.width + x)) + i],
                    analytic.exact(x, y).rgba[i], 2e-5);
      }
    }
  }
}

// Values are clamped at the edge, so one thick layer is the same field as two equal layers of half
// its thickness.
TEST(Reference, OneLayerEqualsTwoHalves) {
  const auto value = [](int i, int j, int) { return ((7 * i + 3 * j) % 13) / 12.0; };
  scene::VolumeScene thick = random_scene(6, Character::smooth, scene::VoxelFormat::u8);
  thick.grid = make_grid({9, 8, 1}, {1, 1, 2}, scene::VoxelFormat::u8, value);
  thick.camera = look_at({9, 8, 14}, {4.5, 4, 1});
  thick.step_voxels = 0.7;
  scene::VolumeScene thin = thick;
  thin.grid = make_grid({9, 8, 2}, {1, 1, 1}, scene::VoxelFormat::u8, value);
  const Truth a = render_volume(thick);
  EXPECT_GT(a.rgba[4 * (11 * 29 + 14)], 0.0);
  EXPECT_LT(largest_difference_of_equal_sizes(a, render_volume(thin)), 1e-13);
}

TEST(Reference, AnisotropicSpacingConvergesToTheClosedForm) {
  for (const double z : {8.0, 1000.0}) {
    AnalyticOptions o;
    o.size = {10, 10, 10};
    o.spacing = {1, 1, z};
    o.width = o.height = 12;
    o.camera = look_at({70, 40, 2.5 * z}, {5, 5, 5 * z});
    const AnalyticScene analytic = analytic_scene(AnalyticProblem::v3_segment, o);
    const Truth truth = render_volume_converged(analytic.scene, 1e-9);
    bool seen = false;
    for (int y = 0; y < truth.height; ++y) {
      for (int x = 0; x < truth.width; ++x) {
        const AnalyticPixel exact = analytic.exact(x, y);
        seen = seen || exact.rgba[3] > 1e-3;
        for (std::size_t i = 0; i < 4; ++i) {
          ASSERT_NEAR(truth.rgba[static_cast<std::size_t>(4 * (y * truth.width + x)) + i],
                      exact.rgba[i], exact.model_error + 1e-9);
        }
      }
    }
    EXPECT_TRUE(seen);
  }
}

TEST(Reference, SameBitsAtAnyPowerOfTwoInScale) {
  scene::VolumeScene scene = random_scene(8, Character::rough, scene::VoxelFormat::u8);
  scene.shading.enabled = true;
  const Truth truth = render_volume(scene, some_model());
  for (const int exponent : {-20, 20}) {
    const double scale = std::ldexp(1.0, exponent);
    scene::VolumeScene scaled = scene;
    auto grid = std::make_shared<scene::VoxelGrid>(*scene.grid);
    for (double& spacing : grid->spacing) spacing *= scale;
    scaled.grid = grid;
    scaled.camera.eye *= scale;
    const Truth other = render_volume(scaled, some_model());
    EXPECT_EQ(truth.rgba, other.rgba) << exponent;
    EXPECT_EQ(truth.bound, other.bound) << exponent;
  }
}

TEST(Reference, TheBackgroundIsBehindTheVolume) {
  scene::VolumeScene scene = random_scene(10, Character::smooth, scene::VoxelFormat::u8);
  const Truth over = render_volume(scene);
  scene.background = {0, 0, 0, 0};
  const Truth alone = render_volume(scene);
  const std::array<double, 4> background{0.25, 0.125, 0.5, 1.0};
  for (std::size_t i = 0; i < over.rgba.size(); ++i) {
    const double alpha = alone.rgba[i / 4 * 4 + 3];
    ASSERT_NEAR(over.rgba[i], alone.rgba[i] + (1 - alpha) * background[i % 4], 1e-14);
  }
}

TEST(Reference, TransparentVolumesShowExactlyTheBackground) {
  scene::VolumeScene scene = random_scene(12, Character::rough, scene::VoxelFormat::f32);
  scene.transfer_function = constant_table({1, 1, 1, 0});
  scene.background = {0.1F, 0.2F, 0.3F, 0.4F};
  const core::Image image = render_volume(scene).image();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) ASSERT_EQ(image.pixel(x, y), scene.background);
  }
}

TEST(Reference, EveryFormatIsTheSameFieldWhereItIsExact) {
  const auto value = [](int i, int j, int k) { return ((i * 5 + j * 3 + k) % 4) / 3.0; };
  scene::VolumeScene scene = random_scene(13, Character::smooth, scene::VoxelFormat::f32);
  scene.camera = look_at({15, 12, 17}, {3, 3, 3});
  scene.grid = make_grid({6, 6, 6}, {1, 1, 1}, scene::VoxelFormat::f32, value);
  const Truth truth = render_volume(scene);
  for (const auto format :
       {scene::VoxelFormat::u8, scene::VoxelFormat::u16, scene::VoxelFormat::f16}) {
    scene.grid = make_grid({6, 6, 6}, {1, 1, 1}, format, value);
    const double rounded = format == scene::VoxelFormat::f16 ? 1e-3 : 1e-6;
    EXPECT_LT(largest_difference_of_equal_sizes(truth, render_volume(scene)), rounded);
  }
}

TEST(Reference, RejectsInvalidScenes) {
  scene::VolumeScene scene;
  EXPECT_THROW((void)render_volume(scene), core::InputError);
  scene = random_scene(1, Character::smooth, scene::VoxelFormat::u8);
  scene.step_voxels = 0;
  EXPECT_THROW((void)render_volume(scene), core::InputError);
  scene.step_voxels = 1;
  auto grid = std::make_shared<scene::VoxelGrid>(*scene.grid);
  grid->data.pop_back();
  scene.grid = grid;
  EXPECT_THROW((void)render_volume_converged(scene, 1e-3), core::InputError);
}

TEST(AnalyticScenes, RejectAnEdgeInsideAVoxel) {
  AnalyticOptions o;
  o.size = {4, 4, 5};
  EXPECT_THROW((void)analytic_scene(AnalyticProblem::v6_layers, o), core::InputError);
}

}  // namespace
}  // namespace triptych::reference
