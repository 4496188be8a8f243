#include "technique/volume/bricks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "scene/generators.hpp"

namespace triptych::technique {
namespace {

// A function that is opaque over one stretch of its table only, or transparent over it only: bricks
// at a corner as well as within may then be the empty ones.
scene::TransferFunction stretch(core::Random& random) {
  scene::TransferFunction function;
  const std::size_t begin = random.bits() % 256;
  const std::size_t end = begin + 1 + random.bits() % 128;
  const bool opaque = random.bits() % 2 == 0;
  for (std::size_t k = 0; k < 256; ++k) {
    function.entries[k][3] = (begin <= k && k < end) == opaque ? 0.5F : 0.0F;
  }
  return function;
}

TEST(Bricks, AnyIsEmptyAgreesWithTheVisibilityOfAll) {
  core::Random random(11);
  int with_empty = 0;
  constexpr int trials = 400;
  const auto grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("gaussian_blob", {24, 24, 24}), scene::VoxelFormat::u8));
  for (int trial = 0; trial < trials; ++trial) {
    const scene::VolumeScene scene{.grid = grid, .transfer_function = stretch(random)};
    for (const Skip skip : {Skip::bricks, Skip::distance}) {
      const BrickLayout layout = brick_layout(scene, skip);
      const auto visible = brick_visibility(brick_ranges(*grid, layout), scene.transfer_function);
      const bool empty = std::ranges::find(visible, 0U) != visible.end();
      ASSERT_EQ(any_brick_is_empty(scene, layout), empty) << trial;
      with_empty += empty ? 1 : 0;
    }
  }
  EXPECT_GT(with_empty, trials / 10);  // both answers were there
  EXPECT_LT(with_empty, 2 * trials - trials / 10);
}

}  // namespace
}  // namespace triptych::technique
