// Compares the reference images of particles with closed-form solutions for spheres.

#include "reference/sphere_closed_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "core/random.hpp"
#include "random_scene.hpp"
#include "reference/spheres.hpp"
#include "sphere_scenes.hpp"

namespace triptych::reference {
namespace {

using std::numbers::pi;

// The bounding rectangle (in zero-based columns and rows) and the number of all non-background
// pixels.
struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
  std::size_t count = 0;
};

Extent extent_of(const SphereTruth& truth) {
  Extent extent;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const auto at = static_cast<std::size_t>(y * truth.width + x);
      if (truth.ids[at] == core::Image::no_particle) continue;
      ++extent.count;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  }
  return extent;
}

TEST(SphereClosedForms, SilhouetteIsTheEllipse) {
  struct Case {
    double theta, sin_alpha, fov;
  };
  for (const Case& c : {Case{0, 0.3, 60}, Case{0.3, 0.2, 60}, Case{0.6, 0.25, 100},
                        Case{1.0, 0.2, 140}, Case{0, 0.02, 3}, Case{0, 0.999, 179}}) {
    const int size = 400;
    const glm::dvec3 centre{std::sin(c.theta), 0, -std::cos(c.theta)};
    auto scene = scene_of(set_of({{centre.x, centre.y, centre.z, c.sin_alpha}}), size, size, c.fov);
    const Extent seen = extent_of(render_spheres(scene));
    const double focal = 0.5 * size / std::tan(c.fov * pi / 360);  // in pixels
    const auto ellipse = s1_silhouette(c.sin_alpha, c.theta, focal);
    ASSERT_TRUE(ellipse);
    const double perimeter = 2 * pi * std::max(ellipse->semi_major, ellipse->semi_minor);
    EXPECT_NEAR(static_cast<double>(seen.count), ellipse->area, 2 * std::sqrt(perimeter) + 2);
    EXPECT_NEAR(seen.right + 1 - seen.left, 2 * ellipse->semi_major, 2);
    EXPECT_NEAR(seen.bottom + 1 - seen.top, 2 * ellipse->semi_minor, 2);
    EXPECT_NEAR(0.5 * (seen.right + 1 + seen.left) - 0.5 * size, ellipse->centre, 1.01);
  }
  EXPECT_FALSE(s1_silhouette(1.0, 0, 1));
  EXPECT_FALSE(s1_silhouette(0.5, 1.1, 1));  // this silhouette is a hyperbola
}

TEST(SphereClosedForms, EntryIsOnTheSphereAndIsWhatIsShown) {
  core::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 centre{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-9, -3)};
    const auto set = set_of({{centre.x, centre.y, centre.z, random.uniform(0.3, 1.5)}});
    const glm::dvec3 stored{set.spheres[0][0], set.spheres[0][1], set.spheres[0][2]};
    const double radius = set.spheres[0][3];
    const auto scene = scene_of(set, 5, 5, 40);
    const SphereTruth truth = render_spheres(scene);
    for (std::size_t p = 0; p < 25; ++p) {
      const glm::dvec3 d =
          scene.camera.ray_direction(static_cast<int>(p % 5), static_cast<int>(p / 5), 5, 5);
      const auto entry = s2_entry(d, stored, radius);
      ASSERT_EQ(entry.has_value(), truth.ids[p] == 0U);
      if (!entry) continue;
      EXPECT_NEAR(glm::length(entry->t * d - stored), radius, 1e-13);
      EXPECT_NEAR(glm::length(entry->normal), 1, 1e-13);
      EXPECT_NEAR(truth.depth[p], entry->t * -d.z, 1e-13);
      const double light = 0.3 + 0.7 * std::abs(glm::dot(entry->normal, d));
      const double red = (set.rgba8[0] & 0xFFU) / 255.0;
      EXPECT_NEAR(truth.rgba[4 * p], red * light, 1e-12);
    }
  }
}

// At a distance of 1e5 radii, the sphere covers a disc that is about 200 pixels wide. The
// intersection of ray and sphere (formula S2) must still decide correctly for every pixel whether
// it is inside.
TEST(SphereClosedForms, FarSpheresKeepTheirMask) {
  const double fov = 2 * std::asin(1e-5) * 180 / pi * 1.3;
  auto scene = scene_of(set_of({{0, 0, 0, 1}}), 256, 256, fov);
  scene.camera = look_at({0, 0, 1e5}, {0, 0, 0}, {0, 1, 0}, fov);
  const SphereTruth truth = render_spheres(scene);
  const double focal = 128 / std::tan(fov * pi / 360);
  const double radius = s1_silhouette(1e-5, 0, focal)->semi_major;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const double rho = std::hypot(x - 127.5, y - 127.5);
      const auto at = static_cast<std::size_t>(y * 256 + x);
      ASSERT_EQ(truth.ids[at] == 0U, rho < radius) << x << ' ' << y;
    }
  }
}

TEST(SphereClosedForms, MeanOfTheHeadlightIsTwoThirds) {
  scene::ParticleSet set = set_of({{0, 0, -1e4, 1}});
  set.rgba8 = {0xFFFFFFFF};
  auto scene = scene_of(std::move(set), 400, 400, 2.2e-4 * 180 / pi);
  scene.shading = {0, 1};
  const SphereTruth truth = render_spheres(scene);
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    if (truth.ids[i] == core::Image::no_particle) continue;
    sum += truth.rgba[4 * i];
    count += 1;
  }
  EXPECT_GT(count, 1e5);
  EXPECT_NEAR(sum / count, s3_mean_cosine, 5e-4);
}

TEST(SphereClosedForms, EqualSpheresMeetInTheBisectingPlane) {
  const glm::dvec3 a{-0.5, 0.125, -4};
  const glm::dvec3 b{0.5, -0.25, -4.5};
  const auto scene = scene_of(set_of({{a.x, a.y, a.z, 1.25}, {b.x, b.y, b.z, 1.25}}), 300, 300, 50);
  const SphereTruth truth = render_spheres(scene);
  std::array<std::size_t, 2> seen{};
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    if (truth.ids[i] == core::Image::no_particle) continue;
    const glm::dvec3 d =
        scene.camera.ray_direction(static_cast<int>(i % 300), static_cast<int>(i / 300), 300, 300);
    const double side = s4_bisector(truth.depth[i] / -d.z * d, a, b);
    ++seen.at(truth.ids[i]);
    EXPECT_GE(truth.ids[i] == 0 ? side : -side, -1e-12) << i;
  }
  EXPECT_GT(seen[0], 1000U);
  EXPECT_GT(seen[1], 1000U);
}

// From far away, spheres look like discs at random positions. Compares the uncovered share of the
// inner window with its expected value.
TEST(SphereClosedForms, RandomDiscsLeaveTheExpectedShareFree) {
  core::Random random(11);
  const double radius = 0.02;
  const std::uint64_t discs = 800;
  std::vector<std::array<double, 4>> spheres;
  for (std::uint64_t i = 0; i < discs; ++i) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    spheres.push_back({x, y, random.uniform(-1, 1), radius});
  }
  auto scene = scene_of(set_of(spheres), 512, 512, 1);
  const double distance = 1e4;  // the window is |x|, |y| < 0.9
  scene.camera =
      look_at({0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.9 / distance) * 180 / pi);
  const double uncovered = 1 - render_spheres(scene).coverage;
  // Let a be the share of the square that one disc covers, N the number of discs, and u the
  // uncovered share. The standard deviation of u is at most about √(N·a²·u²).
  const double area = pi * radius * radius / 4;
  const double expected = s5_uncovered(discs, radius, 4);
  EXPECT_NEAR(expected, 0.778, 1e-3);
  EXPECT_NEAR(uncovered, expected, 4 * expected * area * std::sqrt(static_cast<double>(discs)));
}

TEST(SphereClosedForms, TightnessOfPolygons) {
  EXPECT_NEAR(s6_tightness(4), pi / 4, 1e-15);
  EXPECT_NEAR(s6_tightness(8), 0.948, 5e-4);
  EXPECT_NEAR(s6_tightness(16), 0.987, 5e-4);
}

}  // namespace
}  // namespace triptych::reference
