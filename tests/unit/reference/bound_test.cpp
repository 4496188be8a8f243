// The error bound must hold for arithmetic of the given precision, but must be tight enough to
// expose a faulty renderer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "float_renderer.hpp"
#include "random_scene.hpp"
#include "reference/opacity.hpp"
#include "reference/volume.hpp"

namespace triptych::reference {
namespace {

struct Comparison {
  int violations = 0;
  int visible = 0;           // pixels that show more than the background
  int visible_exceeded = 0;  // visible pixels whose error exceeds their bound
  double largest_ratio = 0;  // the largest ratio of an error to its bound
  double largest_bound = 0;
};

Comparison compare(const core::Image& image, const Truth& truth,
                   const std::array<float, 4>& background) {
  Comparison c;
  for (std::size_t pixel = 0; pixel < truth.bound.size(); ++pixel) {
    double error = 0;
    double opacity = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double value = truth.rgba[4 * pixel + i];
      error = std::max(error, std::abs(static_cast<double>(image.rgba[4 * pixel + i]) - value));
      opacity = std::max(opacity, std::abs(value - static_cast<double>(background[i])));
    }
    const bool exceeded = !(error <= truth.bound[pixel]);
    if (exceeded) ++c.violations;
    if (opacity > 1e-3) {
      ++c.visible;
      if (exceeded) ++c.visible_exceeded;
    }
    if (truth.bound[pixel] > 0)
      c.largest_ratio = std::max(c.largest_ratio, error / truth.bound[pixel]);
    c.largest_bound = std::max(c.largest_bound, truth.bound[pixel]);
  }
  return c;
}

Comparison compare(const scene::VolumeScene& scene, const FloatOptions& options) {
  return compare(render_float(scene, options), render_volume(scene, float_model(scene, options)),
                 scene.background);
}

constexpr std::array formats{scene::VoxelFormat::u8, scene::VoxelFormat::u16,
                             scene::VoxelFormat::f32};

TEST(Bound, HoldsForSinglePrecisionOnRandomScenes) {
  double largest_ratio = 0;
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    for (const Character character : {Character::smooth, Character::rough}) {
      scene::VolumeScene scene = random_scene(seed, character, formats[seed % 3]);
      scene.step_voxels = std::array{0.37, 1.0, 0.5, 2.3}[seed / 3 % 4];
      scene.shading.enabled = seed % 2 == 1;
      FloatOptions options;
      options.ert = seed / 2 % 3 == 0 ? 1.0 / 512 : 0.0;
      options.weight_bits = seed % 5 == 0 ? 8 : 0;
      const Comparison c = compare(scene, options);
      EXPECT_EQ(c.violations, 0) << "seed " << seed << ", largest error/bound " << c.largest_ratio;
      largest_ratio = std::max(largest_ratio, c.largest_ratio);
    }
  }
  // Any huge number would be a valid bound. To show that the bound is not too large, the error of
  // some pixel must come reasonably close to it.
  EXPECT_GT(largest_ratio, 0.05);
}

// Tests every kind of ray that needs a separate rule: in a face, along an edge, from a corner, with
// direction components of zero, grazing, and through a silhouette. With an opaque table, a missing
// sample has its full effect.
TEST(Bound, HoldsForRaysThatGrazeTheBox) {
  const std::array<glm::dvec3, 7> eyes{
      {{0, 4, 30}, {0, 0, 30}, {8, 8, 30}, {1e-7, 4, 30}, {8 + 1e-6, 4, 30}, {0, 0, 0}, {8, 4, 4}}};
  for (const float alpha : {0.05F, 1.0F}) {
    for (const glm::dvec3& eye : eyes) {
      for (const double step : {0.5, 1.0}) {
        scene::VolumeScene scene = random_scene(5, Character::rough, scene::VoxelFormat::f32);
        scene.grid = make_grid({8, 8, 8}, {1, 1, 1}, scene::VoxelFormat::f32,
                               [](int i, int j, int k) { return ((i + j + k) % 3) / 2.0; });
        scene.transfer_function = constant_table({0.9F, 0.5F, 0.1F, alpha});
        scene.camera = look_at(eye, eye - glm::dvec3{0, 0, 1});
        scene.width = scene.height = 33;
        scene.step_voxels = step;
        const Comparison c = compare(scene, {});
        EXPECT_EQ(c.violations, 0)
            << eye.x << ' ' << eye.y << " alpha " << alpha << " ratio " << c.largest_ratio;
      }
    }
  }
}

// If a device computes all positions with the same error, its image is the one that a perfect
// device would draw with the eye displaced by that error. Such an image uses up the entire position
// error, so it reveals everything that the bound might have overlooked: neighbouring cells and
// table entries, a sampling lattice that slides along a grazing ray, and samples that appear at the
// end of the ray.
Comparison compare_displaced(const scene::VolumeScene& scene, const glm::dvec3& sign,
                             double voxels) {
  ErrorModel model;
  model.position_error_voxels = voxels;
  model.compositing_error = 0x1.0p-24;  // the image is rounded to floats
  scene::VolumeScene displaced = scene;
  for (int axis = 0; axis < 3; ++axis) {
    displaced.camera.eye[axis] +=
        0.999 * voxels * sign[axis] * scene.grid->spacing[static_cast<std::size_t>(axis)];
  }
  return compare(render_volume(displaced).image(), render_volume(scene, model), scene.background);
}

// When the eye moves, the cuts through cells move as well, and cells at grazing angles appear and
// disappear. The quadrature error itself therefore changes.
TEST(Bound, ForCellsHoldsForADisplacedEye) {
  double largest_ratio = 0;
  for (std::uint64_t seed = 208; seed < 216; ++seed) {
    scene::VolumeScene scene = random_scene(
        seed, seed % 3 == 0 ? Character::smooth : Character::rough, formats[seed / 3 % 3]);
    scene.quadrature = scene::Quadrature::cells;
    scene.width = scene.height = 13;  // the bound for a ray takes a millisecond to compute
    scene.step_voxels = seed % 2 == 0 ? 1.0 : 0.4;
    scene.shading.enabled = seed % 4 < 2;
    // Each seed tests every displacement in one of two directions, which alternate. Odd seeds begin
    // with the other direction than even seeds, so each displacement is tested in both directions.
    glm::dvec3 sign = seed % 2 == 0 ? glm::dvec3{1, 1, 1} : glm::dvec3{1, -1, -1};
    for (const double voxels : {1e-5, 1e-3, 0.02}) {
      const Comparison c = compare_displaced(scene, sign, voxels);
      EXPECT_EQ(c.violations, 0) << "seed " << seed << ", voxels " << voxels
                                 << ", largest error/bound " << c.largest_ratio;
      largest_ratio = std::max(largest_ratio, c.largest_ratio);
      sign = {1, -sign.y, -sign.z};
    }
  }
  EXPECT_GT(largest_ratio, 0.3);
}

TEST(Bound, HoldsForADisplacedEye) {
  double largest_ratio = 0;
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    scene::VolumeScene scene = random_scene(
        seed, seed % 3 == 0 ? Character::smooth : Character::rough, formats[seed / 3 % 3]);
    scene.step_voxels = seed % 2 == 0 ? 0.5 : 1.3;
    scene.shading.enabled = seed % 4 == 1;
    for (const double voxels : {1e-5, 1e-3, 0.02}) {
      for (const glm::dvec3& sign : {glm::dvec3{1, 1, 1}, {-1, 1, 1}, {1, -1, -1}, {-1, -1, 1}}) {
        const Comparison c = compare_displaced(scene, sign, voxels);
        EXPECT_EQ(c.violations, 0) << "seed " << seed << ", voxels " << voxels
                                   << ", largest error/bound " << c.largest_ratio;
        largest_ratio = std::max(largest_ratio, c.largest_ratio);
      }
    }
  }
  EXPECT_GT(largest_ratio, 0.5);
}

// Rays enter and leave at a small angle to the faces. The opacity is either the same everywhere, or
// it jumps from 0 to 1, so that a missing sample at the end of a ray has its full effect. Colours
// change along the rays.
TEST(Bound, HoldsForADisplacedEyeAtGrazingIncidence) {
  for (const double height : {0.01, 0.2, -0.05}) {
    for (const float alpha : {0.2F, 1.0F}) {
      scene::VolumeScene scene = random_scene(5, Character::smooth, scene::VoxelFormat::f32);
      scene.grid = make_grid({16, 8, 16}, {1, 1, 1}, scene::VoxelFormat::f32,
                             [](int i, int, int k) { return ((i + 2 * k) % 5) / 4.0; });
      scene.transfer_function = constant_table({0, 0, 0, alpha});
      for (std::size_t k = 0; k < 256; ++k) {
        scene.transfer_function.entries[k][0] = static_cast<float>(k) / 255.0F;
        if (alpha == 1.0F) scene.transfer_function.entries[k][3] = k < 200 ? 0.0F : 1.0F;
      }
      scene.camera = look_at({7.3, 8 + height, 30}, {7.6, 8 - height, 0}, {0, 1, 0}, 8);
      scene.width = scene.height = 41;
      for (const double voxels : {1e-4, 1e-2}) {
        for (const glm::dvec3& sign : {glm::dvec3{1, 1, 1}, {-1, 1, -1}, {1, -1, 1}}) {
          const Comparison c = compare_displaced(scene, sign, voxels);
          EXPECT_EQ(c.violations, 0) << height << ' ' << alpha << ' ' << voxels;
        }
      }
    }
  }
}

TEST(Bound, IsSmallOnSmoothScenes) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    scene::VolumeScene scene = random_scene(seed, Character::smooth, formats[seed % 3]);
    scene.shading.enabled = seed % 2 == 1;
    const Truth truth = render_volume(scene, float_model(scene, {}));
    EXPECT_LT(*std::max_element(truth.bound.begin(), truth.bound.end()), 2e-3) << seed;
  }
}

TEST(Bound, DetectsAHalfVoxelShift) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const scene::VolumeScene scene = random_scene(seed, Character::smooth, scene::VoxelFormat::u8);
    FloatOptions shifted;
    shifted.shift_voxels = 0.5;
    const Comparison c = compare(render_float(scene, shifted),
                                 render_volume(scene, float_model(scene, {})), scene.background);
    EXPECT_GT(c.visible, 50) << seed;
    EXPECT_GT(c.visible_exceeded, c.visible * 3 / 4) << seed;
  }
}

TEST(Bound, DetectsEarlyTerminationThatIsNotAllowed) {
  scene::VolumeScene scene = random_scene(3, Character::smooth, scene::VoxelFormat::u8);
  for (auto& entry : scene.transfer_function.entries) entry[3] = 0.3F;
  FloatOptions early;
  early.ert = 1.0 / 64;
  EXPECT_EQ(compare(scene, early).violations, 0);
  const Comparison forbidden = compare(
      render_float(scene, early), render_volume(scene, float_model(scene, {})), scene.background);
  EXPECT_GT(forbidden.violations, 100);
}

TEST(Bound, EarlyTerminationAddsAtMostItsShareOfTheColourBehind) {
  scene::VolumeScene scene = random_scene(3, Character::smooth, scene::VoxelFormat::u8);
  for (auto& entry : scene.transfer_function.entries) entry[3] = 0.5F;
  ErrorModel model;
  model.ert = 1.0 / 512;
  const Truth truth = render_volume(scene, model);
  const double largest = *std::max_element(truth.bound.begin(), truth.bound.end());
  EXPECT_LE(largest, 1.0 / 512);
  EXPECT_GT(largest, 0.1 / 512);
}

TEST(Bound, IsZeroWhereNothingIsVisible) {
  scene::VolumeScene scene = random_scene(7, Character::rough, scene::VoxelFormat::u16);
  scene.transfer_function = constant_table({1, 1, 1, 0});
  const Truth truth = render_volume(scene, float_model(scene, {}));
  for (const double bound : truth.bound) EXPECT_EQ(bound, 0.0);
}

TEST(Bound, IsZeroForAPerfectDevice) {
  const Truth truth = render_volume(random_scene(7, Character::rough, scene::VoxelFormat::u8));
  for (const double bound : truth.bound) EXPECT_EQ(bound, 0.0);
}

TEST(Bound, DoesNotChangeTheImage) {
  scene::VolumeScene scene = random_scene(9, Character::rough, scene::VoxelFormat::f32);
  scene.shading.enabled = true;
  const Truth plain = render_volume(scene);
  const Truth bounded = render_volume(scene, float_model(scene, {}));
  for (std::size_t i = 0; i < plain.rgba.size(); ++i) {
    ASSERT_NEAR(plain.rgba[i], bounded.rgba[i], 1e-15) << i;
  }
}

TEST(Bound, GrowsWithEveryTermOfTheModel) {
  scene::VolumeScene scene = random_scene(11, Character::smooth, scene::VoxelFormat::f32);
  scene.shading.enabled = true;
  const auto total = [&](const ErrorModel& model) {
    double sum = 0;
    for (const double bound : render_volume(scene, model).bound) sum += bound;
    return sum;
  };
  for (double ErrorModel::*term :
       {&ErrorModel::position_error_voxels, &ErrorModel::value_error, &ErrorModel::voxel_rounding,
        &ErrorModel::filter_weight_error, &ErrorModel::table_error, &ErrorModel::opacity_error,
        &ErrorModel::compositing_error}) {
    ErrorModel first;
    first.*term = 1e-5;
    ErrorModel second;
    second.*term = 2e-5;
    EXPECT_GT(total(first), 0.0);
    EXPECT_NEAR(total(second) / total(first), 2.0, 0.1);  // the bound is proportional to each error
  }
}

// The function step_opacity() bounds the opacity of a step either by a fast estimate for small
// errors, or by the opacities at both ends of the allowed range. Compares both bounds with a search
// through this range.
TEST(StepOpacity, EnclosesEveryAllowedValue) {
  for (const double alpha : {1e-6, 0.01, 0.5, 0.99, 1 - 1e-7, 1.0}) {
    for (const double error : {0.0, 1e-8, 1e-4, 0.03}) {
      for (const double steps : {0.1, 0.5, 1.0, 3.0, 40.0}) {
        TableLookup lookup;
        lookup.alpha = alpha;
        lookup.alpha_lo = std::max(alpha - error, 0.0);
        lookup.alpha_hi = std::min(alpha + error, 1.0);
        const StepOpacity opacity = step_opacity(lookup, {steps, steps, steps}, 0.0);
        for (int n = 0; n <= 20; ++n) {
          const double a = lookup.alpha_lo + n / 20.0 * (lookup.alpha_hi - lookup.alpha_lo);
          const double value = step_opacity(std::min(a, 1.0), steps);
          EXPECT_GE(value, opacity.lo - 1e-15) << alpha << ' ' << error << ' ' << steps;
          EXPECT_LE(value, opacity.hi + 1e-15) << alpha << ' ' << error << ' ' << steps;
        }
      }
    }
  }
}

TEST(StepOpacity, OfOneValueIsCorrectedForTheStep) {
  EXPECT_EQ(step_opacity(0.3, 1.0), 0.3);
  EXPECT_NEAR(step_opacity(0.3, 2.0), 1 - 0.49, 1e-16);
  EXPECT_EQ(step_opacity(1.0, 0.001), 1.0);
  EXPECT_EQ(step_opacity(1.0, 0.0), 0.0);
  EXPECT_EQ(step_opacity(0.0, 5.0), 0.0);
  EXPECT_NEAR(step_opacity(1e-12, 0.5) / 5e-13, 1.0, 1e-11);
}

TEST(Truth, BoundIsRoundedUpAndImageToNearest) {
  Truth truth;
  truth.width = 1;
  truth.height = 1;
  truth.rgba = {0.1, 0.2, 0.3, 1.0};
  truth.bound = {0.1 - 1e-12};
  EXPECT_EQ(truth.image().pixel(0, 0), (std::array{0.1F, 0.2F, 0.3F, 1.0F}));
  for (const float bound : truth.bound_image().rgba) {
    EXPECT_GE(static_cast<double>(bound), truth.bound[0]);
    EXPECT_LE(bound, std::nextafter(0.1F, 1.0F));
  }
}

}  // namespace
}  // namespace triptych::reference
