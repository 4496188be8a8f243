// Tests the image in the limit of small steps: the order of its quadrature rule, the number of
// points that it needs, and its stated tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "random_scene.hpp"
#include "reference/piece_of_ray.hpp"
#include "reference/polynomial.hpp"
#include "reference/volume.hpp"
#include "scene/generators.hpp"
#include "tests/support/fitted_order.hpp"

namespace triptych::reference {
namespace {

// Returns the light of a ray segment with nonlinear extinction and colour.
PieceLight bent(double begin, double end) {
  return gauss_light(end - begin, [&](double share) {
    const double t = begin + share * (end - begin);
    return RayPoint{1 + std::sin(2 * t), {std::cos(t), t * t, 0.5}};
  });
}

PieceLight bent_in_parts(int parts) {
  PieceLight sum;
  for (int i = 0; i < parts; ++i) {
    sum = sum.before(bent(2.0 * i / parts, 2.0 * (i + 1) / parts));
  }
  return sum;
}

TEST(PieceOfRay, IsOfSixthOrder) {
  const PieceLight exact = bent_in_parts(256);
  std::vector<double> sizes;
  std::vector<double> errors;
  for (const int parts : {2, 4, 8}) {
    sizes.push_back(1.0 / parts);
    errors.push_back(difference(bent_in_parts(parts), exact));
  }
  EXPECT_GT(test::fitted_order(sizes, errors), 5.7);
}

TEST(PieceOfRay, OfOneColourIsItsOpacityTimesTheColour) {
  for (const double depth : {1e-9, 0.3, 5.0, 1e3, 1e9}) {
    const PieceLight light = gauss_light(depth, [](double) { return RayPoint{1, {0.25, 1, 0}}; });
    EXPECT_NEAR(light.colour[0], 0.25 * light.opacity(), 1e-15);
    EXPECT_NEAR(light.colour[1], -std::expm1(-depth), 1e-15 + 1e-14 * light.colour[1]);
  }
}

TEST(Polynomial, ChangesItsSignAtItsRoots) {
  // The polynomial is (s − 0.2)(s − 0.5)²(s − 0.9)(s + 3)(s − 7). At 0.5, it touches zero without
  // changing its sign.
  std::vector<double> c{1};
  for (const double root : {0.2, 0.5, 0.5, 0.9, -3.0, 7.0}) {
    c.push_back(0);
    for (std::size_t k = c.size(); k-- > 1;) c[k] = c[k - 1] - root * c[k];
    c[0] *= -root;
  }
  std::array<double, 7> coefficients;
  std::copy(c.begin(), c.end(), coefficients.begin());
  std::vector<double> roots;
  append_roots(coefficients, roots);
  ASSERT_GE(roots.size(), 2U);
  EXPECT_NEAR(roots.front(), 0.2, 1e-12);
  EXPECT_NEAR(roots.back(), 0.9, 1e-12);
  for (std::size_t i = 1; i + 1 < roots.size(); ++i) EXPECT_NEAR(roots[i], 0.5, 1e-6);

  roots.clear();
  append_roots(std::array<double, 4>{0.1, 0, 0, 1}, roots);
  append_roots(std::array<double, 7>{}, roots);
  EXPECT_TRUE(roots.empty());
}

scene::VolumeScene lit_scene(const char* function, bool shaded) {
  scene::VolumeScene scene;
  scene.grid = std::make_shared<const scene::VoxelGrid>(
      scene::encode(scene::generate_volume("mandelbulb", {24, 24, 24}), scene::VoxelFormat::f32));
  scene.transfer_function = scene::load_transfer_function(function);
  scene.camera = look_at({40, 30, 50}, {12, 12, 12});
  scene.width = scene.height = 16;
  scene.shading.enabled = shaded;
  return scene;
}

double largest_difference(const Truth& a, const Truth& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  }
  return largest;
}

double largest_bound(const Truth& truth) {
  return *std::max_element(truth.bound.begin(), truth.bound.end());
}

TEST(Converged, StaysWithinItsStatedTolerance) {
  for (const char* function : {"haze", "surfaces"}) {
    for (const bool shaded : {false, true}) {
      const scene::VolumeScene scene = lit_scene(function, shaded);
      const Truth fine = render_volume_converged(scene, 1e-11);
      for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
        const Truth limit = render_volume_converged(scene, tolerance);
        EXPECT_LE(largest_bound(limit), tolerance) << function << shaded;
        EXPECT_LE(largest_difference(limit, fine), 0.1 * tolerance) << function << shaded;
      }
    }
  }
}

// The rough table has jumps, contains the opacities 0 and 1, and has a kink at every entry.
TEST(Converged, StaysWithinItsToleranceAcrossOpacityOne) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    scene::VolumeScene scene = random_scene(seed, Character::rough, scene::VoxelFormat::f32);
    scene.width = scene.height = 12;
    const Truth fine = render_volume_converged(scene, 1e-10);
    for (const double tolerance : {1e-4, 1e-6}) {
      const Truth limit = render_volume_converged(scene, tolerance);
      EXPECT_LE(largest_bound(limit), tolerance);
      EXPECT_LE(largest_difference(limit, fine), 0.1 * tolerance);
    }
  }
}

// Nothing behind an opaque layer may be visible, however thin the layer is.
TEST(Converged, ShowsTheFrontOfOpaqueLayers) {
  scene::VolumeScene scene;
  scene.grid = make_grid({4, 4, 16}, {1, 1, 1}, scene::VoxelFormat::f32,
                         [](int, int, int k) { return k / 16.0; });
  for (std::size_t k = 0; k < 256; ++k) {
    const float alpha = k < 100 ? 0.0F : 1.0F;
    scene.transfer_function.entries[k] = {k <= 100 ? 0.25F : 1.0F, 0.5F, 0, alpha};
  }
  scene.camera = look_at({2, 2, -20}, {2, 2, 8}, {0, 1, 0}, 4);
  scene.width = scene.height = 4;
  const Truth limit = render_volume_converged(scene, 1e-9);
  for (std::size_t pixel = 0; pixel < 16; ++pixel) {
    EXPECT_NEAR(limit.rgba[4 * pixel], 0.25, 1e-8);
    EXPECT_NEAR(limit.rgba[4 * pixel + 1], 0.5, 1e-8);
    EXPECT_NEAR(limit.rgba[4 * pixel + 3], 1.0, 1e-12);
  }
}

// If rays are cut at the kinks of the shading, shading requires hardly any additional points.
TEST(Converged, NeedsFewPointsEvenWithShading) {
  const auto points = [](const char* function, bool shaded) {
    return static_cast<double>(
        render_volume_converged(lit_scene(function, shaded), 0x1.0p-24).samples);
  };
  for (const char* function : {"haze", "surfaces"}) {
    EXPECT_LT(points(function, true), 1.08 * points(function, false)) << function;
  }
}

}  // namespace
}  // namespace triptych::reference
