// Every deviation of rays and spheres that the error model permits must stay within the bounds of
// the reference image, and the bounds must not be wider than necessary.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "random_scene.hpp"
#include "reference/spheres.hpp"
#include "sphere_scenes.hpp"

namespace triptych::reference {
namespace {

double difference(const SphereTruth& truth, std::size_t i, const VisibleSphere& shown) {
  double largest = 0;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    largest = std::max(largest, std::abs(truth.rgba[4 * i + channel] - shown.rgba[channel]));
  }
  return largest;
}

struct Place {
  double x, y;
};

// Returns positions around the centre of pixel `i`: half of them at a distance just below `reach`
// pixels, and half of them at half of this distance.
std::vector<Place> places_around(std::size_t i, int width, double reach) {
  const double x = static_cast<double>(i % static_cast<std::size_t>(width)) + 0.5;
  const double y = static_cast<double>(i / static_cast<std::size_t>(width)) + 0.5;
  std::vector<Place> places;
  for (const double radius : {0.999999 * reach, 0.5 * reach}) {
    for (int k = 0; k < 16; ++k) {
      const double angle = 2 * std::numbers::pi * k / 16;
      places.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
    }
  }
  return places;
}

// Checks rays near each pixel. The renderer marks a pixel as certain if no permitted error can
// change which sphere is visible there. For rays within `margin_px` pixels of the pixel's centre
// (or `lateral_px`, if that is more), a certain pixel must keep its id, and any other pixel must
// keep its colour within the bound. For rays within `lateral_px` pixels, the depth and colour of a
// certain pixel must stay within their bounds.
void expect_bounded(const scene::ParticleScene& scene, const SphereErrorModel& model,
                    const std::string& what) {
  const SphereTruth truth = render_spheres(scene, model);
  const double rounding = 1e-9;
  std::size_t wrong_id = 0;
  std::size_t wrong_colour = 0;
  std::size_t wrong_depth = 0;
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    const bool certain = truth.certain[i] != 0;
    for (const Place& place :
         places_around(i, scene.width, std::max(model.margin_px, model.lateral_px))) {
      const VisibleSphere shown = brute_force(scene, ray_at(scene, place.x, place.y));
      if (certain && shown.id != truth.ids[i]) ++wrong_id;
      if (!certain && difference(truth, i, shown) > truth.bound[i] + rounding) ++wrong_colour;
    }
    if (!certain) continue;
    for (const Place& place : places_around(i, scene.width, model.lateral_px)) {
      const VisibleSphere shown = brute_force(scene, ray_at(scene, place.x, place.y));
      if (difference(truth, i, shown) > truth.bound[i] + rounding) ++wrong_colour;
      if (shown.depth == truth.depth[i]) continue;
      const double off = std::abs(shown.depth - truth.depth[i]);
      if (!(off <= truth.depth_bound[i] + rounding)) ++wrong_depth;
    }
  }
  EXPECT_EQ(wrong_id, 0U) << what;
  EXPECT_EQ(wrong_colour, 0U) << what;
  EXPECT_EQ(wrong_depth, 0U) << what;
}

TEST(SphereBounds, CoverEveryRayThatTheModelAllows) {
  auto scene = scene_of(random_set(1, 250, 0.01, 0.3), 24, 18, 60);
  SphereErrorModel model;
  for (const double margin : {1.0 / 256, 0.3}) {
    for (const double lateral : {0.0, 1e-3, 0.05}) {
      model.margin_px = margin;
      model.lateral_px = lateral;
      const std::string what = std::to_string(margin) + ", " + std::to_string(lateral);
      scene.camera = look_at({1, 0.8, 2}, {0, 0, 0});
      expect_bounded(scene, model, what + " outside");
      scene.camera = look_at({0, 0, 0}, {1, 0.2, 0.1}, {0, 1, 0}, 110);
      expect_bounded(scene, model, what + " in the middle");
      scene.camera = look_at({0, 0.1, 1.3}, {0, 0, 0}, {0, 1, 0}, 160);
      expect_bounded(scene, model, what + " 160 degrees");
    }
  }
}

// The eye is inside the sphere, but not at its centre. Therefore the depth changes when the centre
// is displaced along the ray.
TEST(SphereBounds, CoverTheInsideOfASphere) {
  auto scene = scene_of(set_of({{0.3, 0, -0.3, 1}}), 15, 15, 40);
  SphereErrorModel model;
  for (const double lateral : {1e-3, 0.05}) {
    model.lateral_px = lateral;
    expect_bounded(scene, model, std::to_string(lateral));
  }
  const SphereTruth truth = render_spheres(scene, model);
  EXPECT_EQ(std::ranges::count(truth.certain, 1), 15 * 15);
}

// Displacing the eye is equivalent to displacing all spheres in the opposite direction. Here, they
// are displaced perpendicular to the ray, by as much as the error model permits.
TEST(SphereBounds, CoverDisplacedCentres) {
  auto scene = scene_of(set_of({{0, 0, 0, 1}}), 64, 64, 0.1);
  SphereErrorModel model;
  model.lateral_relative = 0.01;  // relative to the radius, which is 1
  const glm::dvec3 eye{0, 0, 1e3};
  scene.camera = look_at(eye, {0, 0, 0}, {0, 1, 0}, 0.15);
  const SphereTruth truth = render_spheres(scene, model);
  EXPECT_GT(truth.coverage, 0.3);
  for (int k = 0; k < 16; ++k) {
    const double angle = 2 * std::numbers::pi * k / 16;
    const double off = 0.9999 * model.lateral_relative;
    scene.camera.eye = eye + off * glm::dvec3{std::cos(angle), std::sin(angle), 0};
    const SphereTruth other = render_spheres(scene, model);
    for (std::size_t i = 0; i < truth.ids.size(); ++i) {
      if (truth.certain[i] == 0) continue;
      ASSERT_EQ(truth.ids[i], other.ids[i]);
      if (truth.depth[i] == other.depth[i]) continue;
      ASSERT_LE(std::abs(truth.depth[i] - other.depth[i]), truth.depth_bound[i] + 1e-9);
      ASSERT_LE(std::abs(truth.rgba[4 * i] - other.rgba[4 * i]), truth.bound[i] + 1e-9);
    }
  }
}

// To first order, the bound equals the largest possible change for a ray that is displaced by a
// fraction of a pixel, and it must not be much larger.
TEST(SphereBounds, AreAsTightAsTheyCanBe) {
  auto scene = scene_of(set_of({{0, 0, -10, 2}}), 101, 101, 30);
  SphereErrorModel model;
  model.lateral_px = 1e-3;
  model.margin_px = 0;
  const SphereTruth truth = render_spheres(scene, model);
  for (std::size_t i = 50 * 101 + 50; i < 51 * 101; ++i) {
    if (truth.certain[i] == 0 || truth.depth[i] > 1e30) continue;
    double depth_change = 0;
    double colour_change = 0;
    for (const Place& place : places_around(i, scene.width, model.lateral_px)) {
      const VisibleSphere shown = brute_force(scene, ray_at(scene, place.x, place.y));
      depth_change = std::max(depth_change, std::abs(shown.depth - truth.depth[i]));
      colour_change = std::max(colour_change, difference(truth, i, shown));
    }
    EXPECT_LE(truth.depth_bound[i], 2 * depth_change + 1e-6);
    EXPECT_LE(truth.bound[i], 1.1 * colour_change + 1e-6);
  }
}

TEST(SphereBounds, OnlyTheSilhouetteIsUncertain) {
  auto scene = scene_of(set_of({{0.137, 0.0711, -10, 2}}), 512, 512, 30);
  SphereErrorModel model;
  model.margin_px = 1.0 / 32;
  const SphereTruth truth = render_spheres(scene, model);
  const auto uncertain = static_cast<double>(std::ranges::count(truth.certain, 0));
  const double rim = 2 * std::sqrt(std::numbers::pi * truth.coverage) * 512;
  const double expected = rim * 2 * model.margin_px;
  EXPECT_GT(expected, 50);
  EXPECT_NEAR(uncertain, expected, 4 * std::sqrt(expected));
}

TEST(SphereBounds, AParticleSmallerThanTheMarginIsNoticed) {
  // The small sphere is between the central ray of the pixel and the rays at the rim of the margin,
  // so it is hit by neither of them.
  const double pixel = 2 * std::tan(std::numbers::pi / 6) / 9;
  const double off = 0.05 * pixel * 2;
  auto scene = scene_of(set_of({{0, 0, -5, 2}, {off, 0, -2, 0.2 * off}}), 9, 9, 60);
  SphereErrorModel model;
  model.margin_px = 0.1;
  const std::size_t middle = 4 * 9 + 4;
  const SphereTruth truth = render_spheres(scene, model);
  EXPECT_EQ(truth.ids[middle], 0U);
  EXPECT_EQ(truth.certain[middle], 0);
  EXPECT_EQ(truth.certain[middle + 1], 1);
  const VisibleSphere speck = brute_force(scene, glm::normalize(glm::dvec3{off, 0, -2}));
  EXPECT_EQ(speck.id, 1U);
  EXPECT_LE(difference(truth, middle, speck), truth.bound[middle]);
  model.margin_px = 0.03;
  EXPECT_EQ(render_spheres(scene, model).certain[middle], 1);
}

TEST(SphereBounds, SurfacesAsNearAsTheDepthErrorAreUncertain) {
  const std::size_t middle = 4 * 9 + 4;
  const auto certain = [&](double apart, double depth_relative) {
    SphereErrorModel model;
    model.depth_relative = depth_relative;
    const auto scene = scene_of(set_of({{0, 0, -5, 2}, {0, 0, -5 - apart, 2}}), 9, 9, 60);
    return render_spheres(scene, model).certain[middle] != 0;
  };
  EXPECT_TRUE(certain(0.25, 1e-3));
  EXPECT_FALSE(certain(0.25, 0.02));  // each surface has an error of 0.14
  EXPECT_FALSE(certain(0.002, 1e-3));
  EXPECT_TRUE(certain(0.002, 1e-5));
  EXPECT_FALSE(certain(0x1p-20, 1e-6));  // almost, but not exactly, the same sphere
}

}  // namespace
}  // namespace triptych::reference
