// Compares the portable sphere maths, compiled as C++, with double precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>

#include "core/random.hpp"
#include "technique/portable/prelude.hpp"

namespace triptych::technique::portable {
namespace {

using glm::dvec3;

float rest(double value) {
  return static_cast<float>(value - static_cast<double>(static_cast<float>(value)));
}

float along_axis(const glm::vec3& p, const dvec3& eye, const dvec3& axis) {
  const glm::vec3 e(eye);
  const glm::vec3 a(axis);
  return tri_along_axis(p.x, p.y, p.z, e.x, e.y, e.z, rest(eye.x), rest(eye.y), rest(eye.z), a.x,
                        a.y, a.z, rest(axis.x), rest(axis.y), rest(axis.z));
}

// The function tri_along_axis() exists for this case: the result must be accurate to the last bit
// even if all three products cancel.
TEST(SphereMath, CameraCoordinatesAreCorrectToTheLastBit) {
  core::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&](double size) {
      return dvec3{random.uniform(-size, size), random.uniform(-size, size),
                   random.uniform(-size, size)};
    };
    const dvec3 axis = glm::normalize(any(1));
    const dvec3 eye = any(1e5);
    // The offset is almost perpendicular to the axis, with a length of up to 1e5.
    dvec3 offset = any(1e5);
    offset -= glm::dot(offset, axis) * axis;
    const glm::vec3 p(eye + offset);
    const double truth = glm::dot(axis, dvec3(p) - eye);
    const double scale = glm::length(dvec3(p) - eye);
    EXPECT_NEAR(along_axis(p, eye, axis), truth, 0x1.0p-24 * std::abs(truth) + 1e-13 * scale);
  }
}

struct Sphere {
  dvec3 centre;
  double radius;
};

TEST(SphereMath, RaysAreClassifiedUpToA100000Radii) {
  core::Random random(2);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const double distance = std::exp(random.uniform(std::log(1.1), std::log(1e5)));
    // Creates a sphere of radius 1 near the axis, and a ray that passes its silhouette at a
    // distance of 1e-5 radii.
    const dvec3 c{random.uniform(-1, 1), random.uniform(-1, 1), distance};
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double off = 1 + (random.uniform() < 0.5 ? -1e-5 : 1e-5);
    const dvec3 v = glm::normalize(c);
    const dvec3 right = glm::normalize(glm::cross(v, dvec3{0, 1, 0}));
    const dvec3 up = glm::cross(right, v);
    const double sine = off / glm::length(c);
    const dvec3 d =
        std::sqrt(1 - sine * sine) * v + sine * (std::cos(angle) * right + std::sin(angle) * up);
    if (!(d.z > 0.05)) continue;
    const float found = tri_sphere_discriminant(
        static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), 1.0F,
        static_cast<float>(d.x / d.z), static_cast<float>(d.y / d.z));
    if ((found >= 0) != (off < 1)) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(SphereMath, TheIntervalEnclosesTheSilhouetteTightly) {
  core::Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const Sphere s{{random.uniform(-4, 4), 0, random.uniform(-3, 8)}, random.uniform(0.1, 2)};
    const glm::vec2 interval =
        tri_sphere_interval(static_cast<float>(s.centre.x), static_cast<float>(s.centre.z),
                            static_cast<float>(s.radius));
    // Finds the range of directions in this plane whose rays meet the sphere in front of the eye.
    // The interval must contain this range.
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    const double distance = std::hypot(s.centre.x, s.centre.z);
    for (int k = -8999; k < 9000; ++k) {
      const double phi = k * std::numbers::pi / 18000;
      const dvec3 d{std::sin(phi), 0, std::cos(phi)};
      const double b = glm::dot(d, s.centre);
      const bool inside = distance < s.radius;
      const bool meets = distance * distance - b * b <= s.radius * s.radius && (inside || b > 0);
      if (!meets) continue;
      low = std::min(low, std::tan(phi));
      high = std::max(high, std::tan(phi));
    }
    if (low > high) {
      // The interval is empty, or smaller than this sampling can resolve.
      EXPECT_TRUE(interval.x > interval.y || interval.y - interval.x < 2e-3 ||
                  std::abs(interval.x) > 1000 || std::abs(interval.y) > 1000);
      continue;
    }
    EXPECT_LE(interval.x, low + 1e-4 * std::abs(low));
    EXPECT_GE(interval.y, high - 1e-4 * std::abs(high));
    if (std::abs(low) < 100) {
      EXPECT_GT(interval.x, low - 2e-3 * (1 + low * low));
    }
    if (std::abs(high) < 100) {
      EXPECT_LT(interval.y, high + 2e-3 * (1 + high * high));
    }
  }
}

TEST(SphereMath, ThePolygonsOutlineIsAccurate) {
  for (int i = -1000; i <= 1000; ++i) {
    const float turns = static_cast<float>(i) / 1000;
    const double angle = 2 * std::numbers::pi * static_cast<double>(turns);
    EXPECT_NEAR(tri_cosine_turns(turns), std::cos(angle), 1e-6);
    if (i >= -750) {
      EXPECT_NEAR(tri_sine_turns(turns), std::sin(angle), 1e-6);
    }
  }
}

TEST(SphereMath, LargerDiscsGetMoreCorners) {
  EXPECT_EQ(tri_adaptive_corners(0.5F), 4);
  EXPECT_EQ(tri_adaptive_corners(1e4F), 16);
  int last = 4;
  for (float radius = 1; radius < 300; radius += 1) {
    const int corners = tri_adaptive_corners(radius);
    EXPECT_GE(corners, last);
    last = corners;
  }
}

TEST(SphereMath, ASpriteLiesInFrontOfItsSphereAndCoversIt) {
  for (const float d : {1.001F, 1.25F, 2.0F, 10.0F, 1e3F, 1e5F}) {
    const float plane = tri_sprite_plane(d, 1);
    EXPECT_LT(plane, d - 1);
    EXPECT_GT(plane, 0);
    EXPECT_LE(tri_silhouette_on_plane(d, 1, plane), tri_sprite_radius(d, 1, plane, 1e-4F, 1));
    EXPECT_LT(tri_sprite_radius(d, 1, plane, 1e-4F, 0.99F), tri_silhouette_on_plane(d, 1, plane));
  }
}

}  // namespace
}  // namespace triptych::technique::portable
