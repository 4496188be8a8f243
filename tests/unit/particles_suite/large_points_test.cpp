// If a sphere is larger than the largest point of a device, it may be drawn as a quad, so some of
// its counts are open, which means that they may differ between correct devices. Compares the
// computed open counts with those of spheres of known size in the image.

#include "suites/particles/large_points.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "suites/particles/suite.hpp"

namespace triptych::particles_suite {
namespace {

// Returns spheres of radius 1, seen from the origin along −z in an image of 200×200 pixels with a
// field of view of 90°. At distance z, a sphere on the axis is 200/√(z² − 1) pixels wide. A margin
// of 1/32 pixel is added to this width.
scene::ParticleScene at_distances(const std::vector<float>& distances) {
  auto set = std::make_shared<scene::ParticleSet>();
  for (const float z : distances) set->spheres.push_back({0, 0, -z, 1});
  scene::ParticleScene scene;
  scene.particles = set;
  scene.camera.fov_y_deg = 90;
  scene.width = 200;
  scene.height = 200;
  return scene;
}

TEST(OpenByQuads, OnlySpheresThatAreLargerThanThePoints) {
  // The spheres are 70.7, 40.9 and 22.4 pixels wide.
  const scene::ParticleScene scene = at_distances({3, 5, 9});
  EXPECT_TRUE(open_counts_of_quads(scene, 71, true).empty());
  EXPECT_EQ(open_counts_of_quads(scene, 70, false).at("vertices"), 3);
  EXPECT_EQ(open_counts_of_quads(scene, 40, false).at("vertices"), 6);
  EXPECT_EQ(open_counts_of_quads(scene, 1, false).at("vertices"), 9);
  EXPECT_EQ(open_counts_of_quads(scene, 70, false).size(), 3)
      << "kept fragments must not be uncertain";
}

TEST(OpenByQuads, FragmentsInTheCornersOfSquares) {
  const scene::ParticleScene round = at_distances({3});
  EXPECT_EQ(open_counts_of_quads(round, 10, false).at("fragments"), 72 * 72 - 70 * 70);
  // Part of the sphere is outside the image. The quad covers up to 72² pixels, and the visible part
  // of the silhouette is 39 pixels wide and 70 pixels high, so 72² − 39 · 70 fragments are open.
  scene::ParticleScene cut = round;
  auto set = std::make_shared<scene::ParticleSet>();
  set->spheres = {{3, 0, -3, 1}};
  cut.particles = set;
  const auto open = open_counts_of_quads(cut, 10, false);
  EXPECT_GT(open.at("fragments"), 2000);
  EXPECT_EQ(open.at("fragments"), open.at("fragments_discarded"));
}

TEST(OpenByQuads, SpheresBehindAndAroundTheEye) {
  EXPECT_TRUE(open_counts_of_quads(at_distances({-3}), 1, false).empty());
  EXPECT_EQ(open_counts_of_quads(at_distances({0}), 199, false).at("vertices"), 3);
  EXPECT_EQ(open_counts_of_quads(at_distances({0}), 199, false).at("fragments"), 0);
  EXPECT_TRUE(open_counts_of_quads(at_distances({0}), 201, false).empty());
}

TEST(OpenByQuads, BehindQuadsOcclusionCullsMore) {
  const auto open = open_counts_of_quads(at_distances({3, 9}), 64, true);
  EXPECT_EQ(open.at("cells_culled"), 2);
  EXPECT_EQ(open.at("vertices"), 8);
  EXPECT_FALSE(open.contains("visible_ids"));
  EXPECT_FALSE(open.contains("cells"));
}

// If the points of a device can be as large as the image, the device draws no quads, so no counts
// are open.
TEST(OpenByQuads, DependOnTheDevicesLargestPoint) {
  const auto suite = make_suite({});
  measure::Configuration configuration;
  for (const measure::Factor& factor : suite->factors()) {
    configuration[factor.name] = factor.default_value;
  }
  configuration["technique"] = "point";
  configuration["data"] = "generate:uniform:100";
  configuration["viewport"] = "64";
  const auto open_with = [&](double largest) {
    return suite->open_counts(configuration, {{"largest_point", largest}, {"sub_pixel_bits", 8}});
  };
  EXPECT_TRUE(open_with(80).empty());
  EXPECT_GT(open_with(1).at("vertices"), 0);
  EXPECT_LE(open_with(1).at("vertices"), 300);
  EXPECT_TRUE(suite->open_counts(configuration, {{"sub_pixel_bits", 8}}).empty())
      << "the device did not report its largest point";
}

}  // namespace
}  // namespace triptych::particles_suite
