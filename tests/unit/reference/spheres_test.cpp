// Compares the reference image of particles with a loop over all particles, and applies changes
// that must not affect the image.

#include "reference/spheres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "random_scene.hpp"
#include "sphere_scenes.hpp"

namespace triptych::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

SphereErrorModel some_sphere_model() {
  SphereErrorModel model;
  model.lateral_px = 1e-3;
  model.lateral_relative = 1e-7;
  model.depth_relative = 1e-6;
  model.colour_relative = 1e-6;
  return model;
}

void expect_equal(const SphereTruth& a, const SphereTruth& b, const std::string& what) {
  EXPECT_EQ(a.rgba, b.rgba) << what;
  EXPECT_EQ(a.depth, b.depth) << what;
  EXPECT_EQ(a.ids, b.ids) << what;
  EXPECT_EQ(a.bound, b.bound) << what;
  EXPECT_EQ(a.depth_bound, b.depth_bound) << what;
  EXPECT_EQ(a.certain, b.certain) << what;
  EXPECT_EQ(a.coverage, b.coverage) << what;
}

// Expects bit-identical results, and returns the number of different particles that are visible, so
// that a test can check that there are enough.
std::size_t expect_brute_force(const scene::ParticleScene& scene, const SphereErrorModel& model,
                               const std::string& what) {
  const SphereTruth truth = render_spheres(scene, model, 2);
  std::size_t wrong = 0;
  std::size_t changes = 0;
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    const int x = static_cast<int>(i) % scene.width;
    const int y = static_cast<int>(i) / scene.width;
    const VisibleSphere shown =
        brute_force(scene, scene.camera.ray_direction(x, y, scene.width, scene.height));
    const std::array<double, 4> rgba{truth.rgba[4 * i], truth.rgba[4 * i + 1],
                                     truth.rgba[4 * i + 2], truth.rgba[4 * i + 3]};
    if (truth.ids[i] != shown.id || truth.depth[i] != shown.depth || rgba != shown.rgba) ++wrong;
    if (i > 0 && truth.ids[i] != truth.ids[i - 1]) ++changes;
  }
  EXPECT_EQ(wrong, 0U) << what;
  return changes;
}

TEST(Spheres, EveryPixelMatchesALoopOverAllSpheres) {
  struct View {
    const char* what;
    scene::Camera camera;
    bool many_visible;
  };
  const glm::dvec3 centre{0, 0, 0};
  const std::vector<View> views{
      {"outside", look_at({2, 1.5, 3}, centre), true},
      {"in the middle of the cloud", look_at(centre, {1, 0.3, 0.2}), true},
      {"150 degrees", look_at({0.2, 0.1, 1.2}, centre, {0, 1, 0}, 150), true},
      {"179 degrees", look_at({0, 0, 1.5}, centre, {0, 1, 0}, 179), false},
      {"all behind the eye", look_at({0, 0, 3}, {0, 0, 4}), false},
      {"centres behind, parts in front", look_at({0, 0, 1.02}, {0, 0, 4}, {0, 1, 0}, 120), false},
      {"1e5 radii away", look_at({2e3, 1e3, 3e3}, centre, {0, 1, 0}, 0.02), true},
      {"along an axis", look_at({0, 0, 4}, centre), true},
  };
  for (const View& view : views) {
    for (const std::uint64_t seed : {1U, 2U}) {
      auto scene = scene_of(random_set(seed, 1500, 0.005, 0.1), 41, 33, 60);
      scene.camera = view.camera;
      for (const SphereErrorModel& model : {SphereErrorModel{}, some_sphere_model()}) {
        const std::size_t changes = expect_brute_force(scene, model, view.what);
        if (view.many_visible) {
          EXPECT_GT(changes, 100U) << view.what;
        }
      }
    }
  }
}

TEST(Spheres, EyeInsideAndCloseToSpheres) {
  scene::ParticleSet set = random_set(3, 300, 0.01, 0.1);
  ASSERT_TRUE(append(set, {0, 0, 0, 1.5}, 300));  // this sphere surrounds all others
  set.rgba8.push_back(0xFF40E0D0);
  ASSERT_TRUE(append(set, {5, 0, 0, 1}, 301));
  set.rgba8.push_back(0xFF123456);
  auto scene = scene_of(std::move(set), 40, 30, 90);
  scene.camera = look_at({0.4, -0.3, 0.2}, {-1, 0, 0}, {0, 1, 0}, 90);
  EXPECT_GT(expect_brute_force(scene, some_sphere_model(), "inside"), 20U);
  const SphereTruth inside = render_spheres(scene);
  EXPECT_EQ(inside.coverage, 1.0);
  scene.camera = look_at({6.0001, 0, 0}, {5, 0, 0}, {0, 1, 0}, 100);
  expect_brute_force(scene, some_sphere_model(), "1.0001 radii, towards it");
  scene.camera = look_at({6.0001, 0, 0}, {6.0001, 1, 0.001}, {1, 0, 0}, 100);
  expect_brute_force(scene, some_sphere_model(), "1.0001 radii, along it");
  scene.camera = look_at({6, 0, 0}, {7, 0, 0}, {0, 1, 0}, 100);
  for (const std::uint8_t certain : render_spheres(scene).certain) {
    EXPECT_EQ(certain, 0)
        << "the eye is on the surface, which may be seen from inside or not at all";
  }
}

TEST(Spheres, OneSphereTenThousandTimesAsLargeAsItsNeighbours) {
  scene::ParticleSet set = random_set(4, 2000, 1e-2, 2e-2);
  ASSERT_TRUE(append(set, {0, -100.2, 0, 100}, 2000));
  set.rgba8.push_back(0xFF00FF00);
  auto scene = scene_of(std::move(set), 48, 48, 50);
  scene.camera = look_at({0.5, 0.4, 3}, {0, 0, 0});
  EXPECT_GT(expect_brute_force(scene, some_sphere_model(), "from above"), 100U);
  scene.camera.eye = {0, -150, 0};  // the eye is inside the large sphere
  EXPECT_EQ(expect_brute_force(scene, some_sphere_model(), "from below"), 0U);
}

TEST(Spheres, RadiusScaleAndAxisParallelRays) {
  auto scene = scene_of(random_set(5, 500, 0.01, 0.3), 33, 33, 60);
  scene.camera.eye = {0, 0, 2};
  for (const double scale : {0.25, 1.0, 3.0}) {
    scene.radius_scale = scale;
    expect_brute_force(scene, some_sphere_model(), std::to_string(scale));
  }
  scene.radius_scale = 1e-60;
  EXPECT_EQ(render_spheres(scene).coverage, 0.0);
  scene.radius_scale = 1e60;
  EXPECT_THROW((void)render_spheres(scene), core::InputError);
}

TEST(Spheres, OrderAndThreadsChangeNothing) {
  const scene::ParticleSet set = random_set(6, 3000, 0.01, 0.2);
  auto scene = scene_of(set, 37, 29, 60);
  scene.camera = look_at({1, 0.4, 1.2}, {0, 0, 0});
  const SphereTruth first = render_spheres(scene, some_sphere_model(), 1);
  EXPECT_GT(first.coverage, 0.5);
  for (const int threads : {0, 2, 3, 64}) {
    expect_equal(first, render_spheres(scene, some_sphere_model(), threads),
                 std::to_string(threads));
  }
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    scene.particles = std::make_shared<const scene::ParticleSet>(shuffled(set, seed));
    expect_equal(first, render_spheres(scene, some_sphere_model()), "shuffled");
  }
}

TEST(Spheres, LowestIdOnATie) {
  std::vector<std::array<double, 4>> twice;
  for (int copy = 0; copy < 9; ++copy) twice.push_back({0, 0, -3, 1});
  const scene::ParticleSet set = set_of(twice);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto scene = scene_of(shuffled(set, seed), 21, 21, 60);
    const SphereTruth truth = render_spheres(scene, some_sphere_model());
    const std::size_t middle = 10 * 21 + 10;
    EXPECT_EQ(truth.ids[middle], 0U);
    EXPECT_EQ(truth.certain[middle], 1);
    EXPECT_LT(truth.bound[middle], 1e-2);
  }
  // The spheres touch at a single point. The lowest id is visible there, but devices need not
  // agree.
  const auto touching = scene_of(set_of({{0, 0, -4, 2}, {0, 0, -3, 1}}), 21, 21, 60);
  const SphereTruth truth = render_spheres(touching);
  EXPECT_EQ(truth.ids[10 * 21 + 10], 0U);
  EXPECT_EQ(truth.certain[10 * 21 + 10], 0);
}

TEST(Spheres, ColoursOfEveryKind) {
  scene::ParticleSet set = set_of({{0, 0, -3, 1}});
  set.rgba8 = {0x80FF3300};
  auto scene = scene_of(set, 1, 1, 60);
  scene.shading = {0.25, 0.5};
  const auto expect = [&](double red, double green, double blue) {
    const SphereTruth truth = render_spheres(scene);
    EXPECT_DOUBLE_EQ(truth.rgba[0], 0.75 * red);
    EXPECT_DOUBLE_EQ(truth.rgba[1], 0.75 * green);
    EXPECT_DOUBLE_EQ(truth.rgba[2], 0.75 * blue);
    EXPECT_DOUBLE_EQ(truth.rgba[3], 1.0);
    EXPECT_DOUBLE_EQ(truth.depth[0], 2.0);
  };
  expect(0, 0.2, 1);
  set.colour = scene::ColourKind::rgba32;
  set.rgba32 = {{0.5F, 0.125F, 2.0F, 0.0F}};
  scene.particles = std::make_shared<const scene::ParticleSet>(set);
  expect(0.5, 0.125, 2);
  set.colour = scene::ColourKind::intensity;
  // Entry k of the table has the intensity (k + ½)/256, so this intensity is a quarter of the way
  // from entry 10 to entry 11.
  set.intensity = {(10 + 0.75F) / 256};
  scene.particles = std::make_shared<const scene::ParticleSet>(set);
  scene.intensity_colours.entries[10] = {1, 0, 0.5F, 0};
  scene.intensity_colours.entries[11] = {0, 1, 0.5F, 0};
  expect(0.75, 0.25, 0.5);
}

TEST(Spheres, ImagesCarryDepthIdsAndBounds) {
  auto scene = scene_of(set_of({{0, 0, -3, 1}}), 31, 31, 90);
  scene.background = {0.125F, 0.25F, 0.5F, 1.0F};
  const SphereTruth truth = render_spheres(scene, some_sphere_model());
  const core::Image image = truth.image();
  const core::Image bound = truth.bound_image();
  EXPECT_EQ(image.pixel(0, 0), scene.background);
  EXPECT_EQ(image.depth.at(0), std::numeric_limits<float>::infinity());
  EXPECT_EQ(image.ids.at(0), core::Image::no_particle);
  EXPECT_EQ(bound.ids.at(0), 0U) << "it is certain that the pixel is empty";
  const std::size_t middle = 15 * 31 + 15;
  EXPECT_FLOAT_EQ(image.depth[middle], 2.0F);
  EXPECT_EQ(image.ids[middle], 0U);
  EXPECT_EQ(bound.ids[middle], 0U);
  EXPECT_GE(static_cast<double>(bound.depth[middle]), truth.depth_bound[middle]);
  EXPECT_GE(static_cast<double>(bound.pixel(15, 15)[3]), truth.bound[middle]);
  std::size_t uncertain = 0;
  for (std::size_t i = 0; i < bound.ids.size(); ++i) {
    EXPECT_EQ(bound.ids[i] == core::Image::no_particle, truth.certain[i] == 0);
    EXPECT_EQ(truth.depth_bound[i] == infinity, truth.certain[i] == 0);
    uncertain += truth.certain[i] == 0 ? 1U : 0U;
  }
  EXPECT_LT(uncertain, 20U);
}

TEST(Spheres, NoParticlesAndNoScene) {
  auto scene = scene_of(set_of({}), 3, 2, 60);
  const SphereTruth truth = render_spheres(scene, some_sphere_model());
  EXPECT_EQ(truth.coverage, 0.0);
  EXPECT_EQ(truth.certain, std::vector<std::uint8_t>(6, 1));
  scene.width = 0;
  EXPECT_THROW((void)render_spheres(scene), core::InputError);
  scene.width = 3;
  scene::ParticleSet colourless = set_of({{0, 0, -3, 1}});
  colourless.rgba8.clear();
  scene.particles = std::make_shared<const scene::ParticleSet>(colourless);
  EXPECT_THROW((void)render_spheres(scene), core::InputError);
  scene.particles = nullptr;
  EXPECT_THROW((void)render_spheres(scene), core::InputError);
}

}  // namespace
}  // namespace triptych::reference
