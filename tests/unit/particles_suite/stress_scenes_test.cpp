// Tests that the stress scenes show what they are meant to test, by comparing their reference
// images with closed-form solutions and with the data from which the scenes were created.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "reference/sphere_closed_forms.hpp"
#include "reference/spheres.hpp"
#include "suites/particles/stress_cases.hpp"
#include "suites/particles/tolerance.hpp"

namespace triptych::particles_suite {
namespace {

constexpr std::uint32_t none = core::Image::no_particle;

struct Rendered {
  scene::ParticleScene scene;
  reference::SphereTruth truth;

  [[nodiscard]] std::set<std::uint32_t> ids() const {
    std::set<std::uint32_t> shown(truth.ids.begin(), truth.ids.end());
    shown.erase(none);
    return shown;
  }
  [[nodiscard]] std::ptrdiff_t covered() const {
    return std::ranges::count_if(truth.ids, [](std::uint32_t id) { return id != none; });
  }
  [[nodiscard]] std::ptrdiff_t uncertain() const { return std::ranges::count(truth.certain, 0); }
};

Rendered render(const std::string& data, bool before = false) {
  StressScene stress = stress_scene(*stress_data(data), scene::ColourKind::rgba8);
  Rendered rendered;
  rendered.scene.particles =
      std::make_shared<const scene::ParticleSet>(std::move(stress.particles));
  rendered.scene.camera = before ? *stress.camera_before : stress.camera;
  rendered.scene.width = stress.width;
  rendered.scene.height = stress.height;
  rendered.truth = reference::render_spheres(
      rendered.scene, error_model(rendered.scene, technique::ComputedAt::pixel));
  return rendered;
}

// If most of an image were uncertain, it would test nothing. Surface edges are uncertain within
// 1/256 pixel on either side. If every pixel contained edges 2.5 times as long as the pixel itself,
// a fiftieth of the image would be uncertain. The tolerance is twice that, because the number of
// uncertain pixels varies randomly in small images.
TEST(StressScenes, AreCertainNearlyEverywhere) {
  for (const StressCase& each : stress_cases()) {
    for (std::size_t i = 0; i < std::max<std::size_t>(each.variants.size(), 1); ++i) {
      const StressData data{&each, each.variants.empty() ? std::string_view() : each.variants[i]};
      if (data.variant == "10000000") continue;  // the same scene as 200000, only larger
      SCOPED_TRACE(name_of(data));
      const Rendered rendered = render(name_of(data));
      const auto pixels = static_cast<double>(rendered.truth.ids.size());
      EXPECT_LE(static_cast<double>(rendered.uncertain()), 0.04 * pixels + 2);
      EXPECT_EQ(rendered.covered() == 0, name_of(data) == "stress:count:0");
    }
  }
}

TEST(StressScenes, AreTheSameImageAtAnyScale) {
  const Rendered unit = render("stress:scale:unit");
  for (const auto& [variant, scale] :
       {std::pair("small", 0x1.0p-20), std::pair("large", 0x1.0p20)}) {
    const Rendered other = render(fmt::format("stress:scale:{}", variant));
    EXPECT_EQ(other.truth.ids, unit.truth.ids);
    EXPECT_EQ(other.scene.camera.near, scale * unit.scene.camera.near);
    for (std::size_t i = 0; i < unit.truth.depth.size(); ++i) {
      if (unit.truth.ids[i] == none) continue;
      ASSERT_NEAR(other.truth.depth[i] / scale, unit.truth.depth[i], 1e-12);
    }
  }
}

// From this distance, both silhouettes are discs, and a unit of length is 32 pixels. A disc of
// radius R covers πR² pixels, give or take a few times √R (Gauss's circle problem).
TEST(StressScenes, FarSilhouettesAreDiscs) {
  for (const char* distance : {"1e3", "1e4", "1e5", "2e5"}) {
    SCOPED_TRACE(distance);
    const Rendered rendered = render(fmt::format("stress:far:{}", distance));
    const auto area = [](double radius) { return std::numbers::pi * radius * radius; };
    EXPECT_NEAR(static_cast<double>(rendered.covered()), area(32) + area(0.6 * 32), 25);
    // Uncertain pixels lie within 1/256 pixel of either rim.
    EXPECT_LE(rendered.uncertain(), 10);
  }
}

TEST(StressScenes, FromInsideOnlyTheEnclosingSphereIsVisible) {
  for (const char* eye : {"centre", "off_centre", "under_surface"}) {
    const Rendered rendered = render(fmt::format("stress:inside:{}", eye));
    EXPECT_EQ(rendered.truth.coverage, 1);
    EXPECT_FALSE(rendered.ids().contains(3)) << "spheres outside must be hidden";
    EXPECT_TRUE(rendered.ids().contains(0));
  }
}

TEST(StressScenes, TheHorizonCrossesTheImage) {
  for (const char* distance : {"1.0001", "1.0006"}) {
    const Rendered rendered = render(fmt::format("stress:skimming:{}", distance));
    EXPECT_GT(rendered.truth.coverage, 0.3);
    EXPECT_LT(rendered.truth.coverage, 0.7);
    EXPECT_GE(rendered.ids().size(), 3U);
  }
}

TEST(StressScenes, TinySpheresAreVisibleOnlyOnPixelCentres) {
  const Rendered rendered = render("stress:subpixel");
  EXPECT_EQ(rendered.covered(), 144);
  EXPECT_EQ(rendered.uncertain(), 0);
  for (const std::uint32_t id : rendered.ids()) EXPECT_EQ(id % 2, 0U);
}

TEST(StressScenes, InvalidSpheresAreCounted) {
  const Rendered with = render("stress:no_sphere:with");
  const Rendered without = render("stress:no_sphere:without");
  EXPECT_EQ(with.scene.particles->dropped, 10U);
  EXPECT_EQ(with.scene.particles->ids, without.scene.particles->ids);
  EXPECT_EQ(with.truth.ids, without.truth.ids);
  const Rendered vanishing = render("stress:no_sphere:vanishing");
  EXPECT_EQ(vanishing.scene.particles->count(), 5U);
  EXPECT_EQ(vanishing.uncertain() - without.uncertain(), 3);
}

TEST(StressScenes, EqualSpheresShowTheLowestId) {
  const Rendered rendered = render("stress:coincident");
  EXPECT_EQ(rendered.ids(), (std::set<std::uint32_t>{0, 1, 2, 3, 4}));
}

// According to the closed-form solution S4 (reference/sphere_closed_forms.hpp), the visible part of
// each sphere is on that sphere's side of every bisecting plane.
TEST(StressScenes, InterpenetratingSpheresMeetInBisectingPlanes) {
  const Rendered rendered = render("stress:interpenetrating");
  const scene::ParticleSet& set = *rendered.scene.particles;
  const auto centre = [&](std::size_t i) {
    return glm::dvec3(set.spheres[i][0], set.spheres[i][1], set.spheres[i][2]);
  };
  const scene::Camera& camera = rendered.scene.camera;
  for (int y = 0; y < rendered.scene.height; ++y) {
    for (int x = 0; x < rendered.scene.width; ++x) {
      const auto at = static_cast<std::size_t>(y * rendered.scene.width + x);
      const std::uint32_t id = rendered.truth.ids[at];
      if (id == none) continue;
      const glm::dvec3 ray =
          camera.ray_direction(x, y, rendered.scene.width, rendered.scene.height);
      const glm::dvec3 hit =
          camera.eye + rendered.truth.depth[at] / glm::dot(ray, camera.forward) * ray;
      for (std::size_t other = 0; other < set.count(); ++other) {
        if (other == id) continue;
        ASSERT_GE(reference::s4_bisector(hit, centre(id), centre(other)), -1e-9) << x << ' ' << y;
      }
    }
  }
}

TEST(StressScenes, AllDepthsAreVisibleAndNearerSpheresHideOthers) {
  const Rendered rendered = render("stress:depth_range");
  ASSERT_EQ(rendered.ids().size(), 7U);
  double nearest = 1e9;
  double farthest = 0;
  for (const double depth : rendered.truth.depth) {
    if (!std::isfinite(depth)) continue;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  EXPECT_GT(farthest / nearest, 1e6);
}

TEST(StressScenes, ThePileShowsOnlyItsLastSphere) {
  const Rendered rendered = render("stress:pile:200000");
  EXPECT_EQ(rendered.ids(), (std::set<std::uint32_t>{199999}));
  EXPECT_EQ(rendered.covered(), 1);
  EXPECT_EQ(rendered.truth.certain[16 * 33 + 16], 1);
}

// Only the wall is visible both before and after the jump.
TEST(StressScenes, AfterTheJumpOtherSpheresAreVisible) {
  const Rendered after = render("stress:jump");
  const Rendered before = render("stress:jump", true);
  static constexpr std::uint32_t in_wall = 441;
  const auto in_crowd = [](const std::set<std::uint32_t>& ids) {
    return std::set<std::uint32_t>(ids.lower_bound(in_wall), ids.end());
  };
  const auto visible_after = in_crowd(after.ids());
  EXPECT_GT(visible_after.size(), 1000U);
  EXPECT_GT(in_crowd(before.ids()).size(), 1000U);
  std::size_t common = 0;
  for (const std::uint32_t id : in_crowd(before.ids())) common += visible_after.count(id);
  EXPECT_EQ(common, 0U);
}

TEST(StressScenes, TheLetterDiffersFromItsFlips) {
  const Rendered rendered = render("stress:asymmetric");
  const auto differing = [&](auto other) {
    int different = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        const auto [u, v] = other(x, y);
        const auto index = static_cast<std::size_t>(y * 96 + x);
        different +=
            rendered.truth.ids[index] != rendered.truth.ids[static_cast<std::size_t>(v * 96 + u)];
      }
    }
    return different;
  };
  const int covered = static_cast<int>(rendered.covered());
  EXPECT_GT(differing([](int x, int y) { return std::pair(95 - x, y); }), covered / 2);
  EXPECT_GT(differing([](int x, int y) { return std::pair(x, 95 - y); }), covered / 2);
  EXPECT_GT(differing([](int x, int y) { return std::pair(95 - x, 95 - y); }), covered / 2);
  EXPECT_GT(differing([](int x, int y) { return std::pair(y, x); }), covered / 2);
}

TEST(StressScenes, SpheresOutsideTheEdgeAreInvisible) {
  const Rendered rendered = render("stress:edges");
  EXPECT_TRUE(rendered.ids().contains(9));
  EXPECT_FALSE(rendered.ids().contains(10));
  for (std::uint32_t id = 0; id < 9; ++id) EXPECT_TRUE(rendered.ids().contains(id)) << id;
}

}  // namespace
}  // namespace triptych::particles_suite
