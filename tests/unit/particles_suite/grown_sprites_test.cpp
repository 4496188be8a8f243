// Tests the computed number of fragments that are added when ray-aligned sprites grow, by comparing
// it with the areas of the sprites in the image.

#include "suites/particles/grown_sprites.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace triptych::particles_suite {
namespace {

// Returns a scene with one sphere, seen from the origin along −z in an image of 200×200 pixels.
scene::ParticleScene one(double x, double z, double radius, double fov_y_deg) {
  auto set = std::make_shared<scene::ParticleSet>();
  set->spheres = {{static_cast<float>(x), 0, static_cast<float>(-z), static_cast<float>(radius)}};
  scene::ParticleScene scene;
  scene.particles = set;
  scene.camera.fov_y_deg = fov_y_deg;
  scene.width = 200;
  scene.height = 200;
  return scene;
}

// A square on the axis with a half edge of h pixels grows by g pixels on each side. This adds 8·h·g
// + 4·g² fragments, give or take one pixel along each border. With a field of view of 90° and 200
// pixels, a pixel has a size of 1/100 at distance 1. The plane of the sprite lies one radius in
// front of the centre of the sphere.
TEST(GrownSprites, OnTheAxisAnEdgeMovesByTheGrowth) {
  const double growth = 3;
  const double plane = 10 - 0.5;
  const double half = 0.5 * 100 / plane;
  const double grown = half + growth * 10 / plane;
  const double expected = 4 * (grown * grown - half * half);
  EXPECT_NEAR(fragments_of_growth(one(0, 10, 0.5, 90), growth), expected, 8 * grown);
}

// At 70° from the axis, a length in the radial direction covers 1/cos 70° times as many pixels, so
// two edges of the sprite become much longer.
TEST(GrownSprites, AwayFromTheAxisEdgesMoveMuchFurther) {
  const double sideways = 10 * std::tan(70 * std::acos(-1.0) / 180);
  const double near_axis = fragments_of_growth(one(0, 10, 1, 150), 1);
  const double far = fragments_of_growth(one(sideways, 10, 1, 150), 1);
  EXPECT_GT(near_axis, 0);
  EXPECT_GT(far, 2 * near_axis);
}

TEST(GrownSprites, NothingBehindTheEye) {
  EXPECT_EQ(fragments_of_growth(one(0, -10, 1, 90), 3), 0);
}

}  // namespace
}  // namespace triptych::particles_suite
