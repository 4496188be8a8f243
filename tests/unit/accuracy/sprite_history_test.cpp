#include "accuracy/sprite_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/image.hpp"

namespace triptych::accuracy {
namespace {

constexpr std::uint32_t no_particle = core::Image::no_particle;

const ExpectedSurface expected{.id = 7,
                               .depth = 2,
                               .depth_bound = 0.01,
                               .colour = {0.5, 0.5, 0.5, 1},
                               .colour_bound = 0.001,
                               .certain = true};

DrawnSurface drawn(std::uint32_t id, double depth, double red) {
  return {.id = id, .depth = depth, .colour = {red, 0.5, 0.5, 1}};
}

TEST(SpriteHistory, ReportsDifferences) {
  EXPECT_EQ(compare(expected, drawn(7, 2.005, 0.5005)), SurfaceDifference::none);
  EXPECT_EQ(compare(expected, drawn(no_particle, 2, 0.5)), SurfaceDifference::missing);
  EXPECT_EQ(compare(expected, drawn(8, 2, 0.5)), SurfaceDifference::particle);
  EXPECT_EQ(compare(expected, drawn(7, 2.02, 0.5)), SurfaceDifference::depth);
  EXPECT_EQ(compare(expected, drawn(7, 2, 0.502)), SurfaceDifference::colour);
  ExpectedSurface none = expected;
  none.id = no_particle;
  EXPECT_EQ(compare(none, drawn(7, 2, 0.5)), SurfaceDifference::unexpected);
  EXPECT_EQ(compare(none, drawn(no_particle, 1e30, 0.5)), SurfaceDifference::none);
}

TEST(SpriteHistory, AllowsAnotherParticleInUncertainPixels) {
  ExpectedSurface edge = expected;
  edge.certain = false;
  edge.colour_bound = 0.5;
  EXPECT_EQ(compare(edge, drawn(no_particle, 2, 0.0)), SurfaceDifference::none);
  EXPECT_EQ(compare(edge, drawn(8, 5, 1.1)), SurfaceDifference::colour);
}

// Of 100 particles, the pixel is wrong if and only if particles 3 and 61 are drawn together.
TEST(SpriteHistory, FindsTheSmallestSetOfParticles) {
  Particles all(100);
  for (std::uint32_t i = 0; i < 100; ++i) all[i] = i;
  int calls = 0;
  const auto wrong = [&](const Particles& particles) {
    ++calls;
    return std::ranges::find(particles, 3U) != particles.end() &&
           std::ranges::find(particles, 61U) != particles.end();
  };
  const SmallestSet smallest_set = smallest_set_of(all, wrong, 1000);
  EXPECT_EQ(smallest_set.particles, (Particles{3, 61}));
  EXPECT_FALSE(smallest_set.stopped_early);
  EXPECT_LT(calls, 100);
  const SmallestSet stopped = smallest_set_of(all, wrong, 3);
  EXPECT_TRUE(stopped.stopped_early);
  EXPECT_TRUE(wrong(stopped.particles));
}

}  // namespace
}  // namespace triptych::accuracy
