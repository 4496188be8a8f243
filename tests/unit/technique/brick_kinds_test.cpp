// Compares the classification of bricks with an exhaustive search over the values in a brick and
// the paths through it.

#include "technique/volume/brick_kinds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.hpp"
#include "scene/generators.hpp"
#include "technique/volume/brick_map.hpp"

namespace triptych::technique {
namespace {

constexpr auto invisible = static_cast<std::int32_t>(BrickKind::invisible);
constexpr auto sampled = static_cast<std::int32_t>(BrickKind::sampled);
constexpr auto merged = static_cast<std::int32_t>(BrickKind::merged);
constexpr auto homogeneous = static_cast<std::int32_t>(BrickKind::homogeneous);

scene::VolumeScene scene_of(scene::Volume volume, std::string_view function) {
  return {.grid = std::make_shared<const scene::VoxelGrid>(
              scene::encode(std::move(volume), scene::VoxelFormat::f32)),
          .transfer_function = scene::load_transfer_function(function)};
}

scene::VolumeScene generated_volume(std::string_view name, std::string_view function) {
  return scene_of(scene::generate_volume(name, {40, 40, 40}), function);
}

// Returns the ranges of a single brick with values from `lo` to `hi`.
BrickRanges one_brick(float lo, float hi) {
  return {.counts = {1, 1, 1}, .minimum = {lo}, .maximum = {hi}};
}

scene::TransferFunction random_function(core::Random& random) {
  scene::TransferFunction function;
  // The roughness varies widely, so that the classification has both outcomes for every budget.
  const double roughness = std::exp2(random.uniform(-16, 0));
  const std::array<double, 4> base{random.uniform(), random.uniform(), random.uniform(),
                                   0.5 * random.uniform()};
  for (auto& entry : function.entries) {
    for (std::size_t c = 0; c < 4; ++c) {
      entry[c] =
          static_cast<float>(std::clamp(base[c] + roughness * (random.uniform() - 0.5), 0.0, 0.9));
    }
  }
  return function;
}

struct Sample {
  std::array<double, 3> colour;
  double extinction;
};

Sample sample_at(const scene::TransferFunction& function, double value) {
  const double position = std::clamp(256 * value - 0.5, 0.0, 255.0);
  const auto below = std::min(static_cast<std::size_t>(position), std::size_t{254});
  const double weight = position - static_cast<double>(below);
  std::array<double, 4> mixed{};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto a = static_cast<double>(function.entries[below][c]);
    const auto b = static_cast<double>(function.entries[below + 1][c]);
    mixed[c] = a + weight * (b - a);
  }
  return {{mixed[0], mixed[1], mixed[2]}, -std::log1p(-mixed[3])};
}

// Composites segments of equal length front to back, in front of a background of brightness
// `behind` (black or white).
std::array<double, 4> composite(const std::vector<Sample>& samples, double length, double behind) {
  std::array<double, 4> sum{};
  double left = 1;
  for (const Sample& sample : samples) {
    const double opacity = -std::expm1(-sample.extinction * length);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += left * opacity * sample.colour[c];
    left *= 1 - opacity;
  }
  for (std::size_t c = 0; c < 3; ++c) sum[c] += left * behind;
  sum[3] = 1 - left;
  return sum;
}

TEST(BrickKinds, MergedBricksStayWithinTheirBudget) {
  core::Random random(11);
  scene::VolumeScene scene = generated_volume("uniform_box", "haze");
  const double longest = 40 * std::sqrt(3.0);
  int merged_bricks = 0;
  for (int n = 0; n < 4000; ++n) {
    scene.transfer_function = random_function(random);
    const double adapt = std::exp2(random.uniform(-12, -2));
    const double lo = random.uniform();
    const double hi = lo + std::exp2(random.uniform(-12, -2));
    const BrickRanges brick = one_brick(static_cast<float>(lo), static_cast<float>(hi));
    if (brick_kinds(brick, scene, adapt)[0] != merged) continue;
    ++merged_bricks;
    // The ray passes only through bricks that can be merged. Merging takes one sample per brick,
    // whereas the sampling lattice takes several.
    const int bricks = 9;
    const int steps = 8;
    std::vector<Sample> lattice;
    std::vector<Sample> taken;
    for (int b = 0; b < bricks; ++b) {
      const bool extreme = random.uniform() < 0.5;
      const Sample middle =
          sample_at(scene.transfer_function, extreme ? hi : random.uniform(lo, hi));
      for (int i = 0; i < steps; ++i) {
        taken.push_back(middle);
        lattice.push_back(
            sample_at(scene.transfer_function, extreme ? lo : random.uniform(lo, hi)));
      }
    }
    for (const double behind : {0.0, 1.0}) {
      const auto exact = composite(lattice, longest / (bricks * steps), behind);
      const auto found = composite(taken, longest / (bricks * steps), behind);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_LE(std::abs(found[c] - exact[c]), adapt) << n;
    }
  }
  EXPECT_GT(merged_bricks, 500);
  EXPECT_LT(merged_bricks, 3500);
}

// Evaluates the merging criterion directly, with the extreme values found by trying many values.
TEST(BrickKinds, FollowTheCriterion) {
  core::Random random(12);
  scene::VolumeScene scene = generated_volume("uniform_box", "haze");
  const double longest = 40 * std::sqrt(3.0);
  int decided = 0;
  for (int n = 0; n < 2000; ++n) {
    scene.transfer_function = random_function(random);
    const double adapt = std::exp2(random.uniform(-12, -2));
    const double lo = random.uniform(0, 0.9);
    const double hi = lo + random.uniform(0, 0.1);
    Sample least = sample_at(scene.transfer_function, lo);
    Sample largest = least;
    const auto widen = [&](double value) {
      const Sample sample = sample_at(scene.transfer_function, value);
      least.extinction = std::min(least.extinction, sample.extinction);
      largest.extinction = std::max(largest.extinction, sample.extinction);
      for (std::size_t c = 0; c < 3; ++c) {
        least.colour[c] = std::min(least.colour[c], sample.colour[c]);
        largest.colour[c] = std::max(largest.colour[c], sample.colour[c]);
      }
    };
    widen(hi);
    for (int k = 0; k < 256; ++k) {
      const double value = (k + 0.5) / 256;
      if (value > lo && value < hi) widen(value);
    }
    double colours = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      colours = std::max(colours, largest.colour[c] - least.colour[c]);
    }
    const double spent = std::min(colours, adapt / 2);
    const double cost =
        largest.extinction - least.extinction + (colours - spent) * largest.extinction;
    const double budget = (adapt / 2 - spent) * least.extinction + adapt / 2 / longest;
    // Skips cases in which round-off could change the decision.
    if (std::abs(cost - budget) < 1e-3 * (cost + budget)) continue;
    ++decided;
    const BrickRanges brick = one_brick(static_cast<float>(lo), static_cast<float>(hi));
    ASSERT_EQ(brick_kinds(brick, scene, adapt)[0] == merged, cost < budget) << n;
  }
  EXPECT_GT(decided, 1900);
}

TEST(BrickKinds, AHomogeneousBrickIsMergedForAnyBudget) {
  const scene::VolumeScene scene = generated_volume("uniform_box", "haze");
  EXPECT_EQ(brick_kinds(one_brick(0.6F, 0.6F), scene, 1e-12)[0], homogeneous);
  EXPECT_EQ(brick_kinds(one_brick(0.6F, 0.7F), scene, 1e-12)[0], sampled);
  EXPECT_EQ(brick_kinds(one_brick(0.0F, 0.0F), scene, 0.5)[0], invisible);
}

TEST(BrickKinds, HomogeneousBricksAreNumberedByTheirValue) {
  const BrickRanges ranges{.counts = {5, 1, 1},
                           .minimum = {0.6F, 0.7F, 0.6F, 0.7F, 0.6F},
                           .maximum = {0.6F, 0.7F, 0.8F, 0.7F, 0.6F}};
  const auto kinds = brick_kinds(ranges, generated_volume("uniform_box", "haze"), 1e-12);
  EXPECT_EQ(kinds, (std::vector<std::int32_t>{homogeneous, homogeneous + 1, sampled,
                                              homogeneous + 1, homogeneous}));
}

TEST(BrickKinds, AnOpaqueBrickIsNotMerged) {
  scene::VolumeScene scene = generated_volume("uniform_box", "haze");
  scene.transfer_function.entries.fill({1, 1, 1, 1});
  EXPECT_EQ(brick_kinds(one_brick(0.2F, 0.4F), scene, 0.5)[0], sampled);
}

// Shading can change the brightness of a brick. The wider the range of its values, the steeper its
// gradients can be, and the larger this change can be.
TEST(BrickKinds, ShadingCountsAsColour) {
  scene::VolumeScene scene = generated_volume("uniform_box", "haze");
  scene.transfer_function.entries.fill({0.5F, 0.5F, 0.5F, 0.25F});
  EXPECT_EQ(brick_kinds(one_brick(0.2F, 0.4F), scene, 1e-3)[0], merged);
  scene.shading.enabled = true;
  EXPECT_EQ(brick_kinds(one_brick(0.2F, 0.4F), scene, 1e-3)[0], sampled);
  EXPECT_EQ(brick_kinds(one_brick(0.4F, 0.4F), scene, 1e-3)[0], homogeneous);
  EXPECT_EQ(brick_layout(scene, Skip::bricks, 1e-3).border, 2);
  EXPECT_EQ(brick_layout(scene, Skip::bricks).border, 1);
}

TEST(BrickKinds, DetermineTheBrickMap) {
  const scene::VolumeScene scene = generated_volume("nested_shells", "haze");
  const auto visible = brick_map(scene, Skip::bricks);
  const auto kinds = brick_map(scene, Skip::bricks, 1e-3);
  ASSERT_EQ(kinds.size(), visible.size());
  for (std::size_t b = 0; b < kinds.size(); ++b) {
    EXPECT_EQ(kinds[b] == invisible, visible[b] == 0);
  }
}

TEST(AdaptReason, ReportsOptionsWithoutBricksToMerge) {
  scene::VolumeScene scene;
  RaycastOptions options{.skip = Skip::bricks};
  EXPECT_FALSE(adapt_reason("speed_of_light", scene, options));
  options.adapt = 1e-3;
  EXPECT_FALSE(adapt_reason("raycast", scene, options));
  EXPECT_TRUE(adapt_reason("speed_of_light", scene, options));
  options.skip = Skip::distance;
  EXPECT_TRUE(adapt_reason("raycast", scene, options));
  options.skip = Skip::none;
  EXPECT_TRUE(adapt_reason("raycast", scene, options));
  options.skip = Skip::bricks;
  scene.quadrature = scene::Quadrature::preintegrated;
  EXPECT_TRUE(adapt_reason("raycast", scene, options));
}

}  // namespace
}  // namespace triptych::technique
