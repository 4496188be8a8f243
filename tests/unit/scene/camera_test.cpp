#include "scene/camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace triptych::scene {
namespace {

using glm::dvec3;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Box cube{{0, 0, 0}, {2, 2, 2}};
const Box slab{{-10, 5, 0}, {30, 6, 13}};

void expect_near(const dvec3& a, const dvec3& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' ' << b.y << ' ' << b.z;
}

std::string spec(std::string_view path, int i, int n) {
  return std::string(path) + ':' + std::to_string(i) + '/' + std::to_string(n);
}

TEST(Camera, RaysFollowTheStatedFormula) {
  Camera camera;
  camera.fov_y_deg = 90;
  expect_near(camera.right(), {1, 0, 0}, 0);
  // The centre pixel of an image with odd width and height looks straight ahead. The corners below
  // belong to a 4×2 image with aspect ratio 2 and tan 45° = 1.
  expect_near(camera.ray_direction(1, 1, 3, 3), {0, 0, -1}, 0);
  expect_near(camera.ray_direction(0, 0, 4, 2), glm::normalize(dvec3(-1.5, 0.5, -1)), 1e-15);
  expect_near(camera.ray_direction(3, 1, 4, 2), glm::normalize(dvec3(1.5, -0.5, -1)), 1e-15);
  camera.fov_y_deg = 60;
  expect_near(camera.ray_direction(0, 0, 1, 2),
              glm::normalize(dvec3(0, 0.5 * std::tan(std::numbers::pi / 6), -1)), 1e-15);
}

// Cameras must be bit-identical on every machine, because all images and counters depend on them.
TEST(Camera, IsTheSameEverywhere) {
  const Box box{glm::dvec3(-3, 0.5, 1), glm::dvec3(40, 30.25, 77)};
  core::HashBuilder bits("cameras");
  const auto add = [&bits](const glm::dvec3& v) { bits.add(v.x).add(v.y).add(v.z); };
  for (const char* spec : {"orbit_x:1/7", "orbit_-y:3/8", "diagonal_x-yz:0/3", "path_z:2/5",
                           "path_sin_x:4/9", "random:7"}) {
    const Camera camera = camera_at(spec, box, 50);
    add(camera.eye);
    add(camera.forward);
    add(camera.up);
    bits.add(tangent_of_half(camera.fov_y_deg)).add(camera.near).add(camera.far);
  }
  EXPECT_EQ(bits.hash(), "30e6e63cb0b17ea34eecf5568c131f5e");
}

TEST(Camera, EveryViewIsOrthonormal) {
  for (const Box& box : {cube, slab}) {
    for (const auto path : camera_paths()) {
      for (int i = 0; i < 36; ++i) {
        const Camera camera = camera_at(spec(path, i, 36), box, 60);
        EXPECT_NEAR(glm::length(camera.forward), 1, 1e-15) << path << i;
        EXPECT_NEAR(glm::length(camera.up), 1, 1e-15) << path << i;
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 4e-15) << path << i;
        EXPECT_NEAR(glm::length(camera.right()), 1, 1e-15) << path << i;
        EXPECT_GT(camera.near, 0);
        EXPECT_GT(camera.far, camera.near);
      }
    }
  }
}

TEST(Camera, OrbitsStartAtTheStatedDistanceAndLookAtTheCentre) {
  for (const std::string path :
       {"orbit_x", "orbit_y", "orbit_z", "orbit_-x", "orbit_-y", "orbit_-z"}) {
    for (int i = 0; i < 12; ++i) {
      const Camera camera = camera_at(spec(path, i, 12), slab, 90);
      const dvec3 to_centre = dvec3(10, 5.5, 6.5) - camera.eye;
      EXPECT_NEAR(glm::length(to_centre), 20 + 20, 1e-13) << path;
      expect_near(camera.forward, glm::normalize(to_centre), 1e-14);
    }
  }
  const Camera narrow = camera_at("orbit_y:0/1", cube, 60);
  expect_near(narrow.eye, {1, 1, 1 + 1 + std::sqrt(3)}, 1e-14);
  EXPECT_EQ(narrow.forward, dvec3(0, 0, -1));
  EXPECT_EQ(narrow.up, dvec3(0, 1, 0));
}

TEST(Camera, OrbitsTurnAboutTheirAxisEvenlyAndClose) {
  const double radius = 2;
  expect_near(camera_at("orbit_y:1/4", cube, 90).eye, {1 + radius, 1, 1}, 1e-14);
  expect_near(camera_at("orbit_-y:1/4", cube, 90).eye, {1 - radius, 1, 1}, 1e-14);
  expect_near(camera_at("orbit_x:1/4", cube, 90).eye, {1, 1 + radius, 1}, 1e-14);
  expect_near(camera_at("orbit_-x:1/4", cube, 90).eye, {1, 1 - radius, 1}, 1e-14);
  expect_near(camera_at("orbit_z:0/4", cube, 90).eye, {1 + radius, 1, 1}, 1e-14);
  expect_near(camera_at("orbit_z:1/4", cube, 90).eye, {1, 1 + radius, 1}, 1e-14);
  const double step = glm::length(camera_at("orbit_x:1/36", cube, 90).eye -
                                  camera_at("orbit_x:0/36", cube, 90).eye);
  for (int i = 1; i < 36; ++i) {
    const dvec3 eye = camera_at(spec("orbit_x", i, 36), cube, 90).eye;
    const dvec3 next = camera_at(spec("orbit_x", (i + 1) % 36, 36), cube, 90).eye;
    EXPECT_NEAR(glm::length(next - eye), step, 1e-14) << i;
  }
}

// The up vector must turn with the orbit: successive views differ by a small rotation, and never by
// a flip.
TEST(Camera, OrbitsNeverFlip) {
  for (const std::string path : {"orbit_x", "orbit_y", "orbit_z"}) {
    for (int i = 0; i < 360; ++i) {
      const Camera current = camera_at(spec(path, i, 360), slab, 60);
      const Camera next = camera_at(spec(path, (i + 1) % 360, 360), slab, 60);
      EXPECT_LT(glm::length(next.up - current.up), 0.018) << path << i;
    }
  }
}

TEST(Camera, StraightPathsEndAtTheCentreLookingAhead) {
  const dvec3 centre(10, 5.5, 6.5);
  constexpr int n = 1000000;
  for (const std::string path :
       {"path_x", "path_y", "path_z", "path_sin_x", "path_sin_y", "path_sin_z"}) {
    const Camera first = camera_at(spec(path, 0, n), slab, 60);
    const Camera last = camera_at(spec(path, n - 1, n), slab, 60);
    EXPECT_LT(glm::length(last.eye - centre), 2e-4) << path;
    EXPECT_EQ(first.forward, last.forward);
    // The path begins at half the extent of the box along the axis, plus the distance at which 40
    // units fill a field of view of 60 degrees.
    const int axis = path.back() - 'x';
    const double half = std::array{20.0, 0.5, 6.5}.at(static_cast<std::size_t>(axis));
    expect_near(first.eye, centre - first.forward * (half + 20 * std::sqrt(3)), 1e-12);
  }
  EXPECT_EQ(camera_at("path_z:0/2", cube, 60).forward, dvec3(0, 0, -1));
  EXPECT_EQ(camera_at("path_y:0/2", cube, 60).up, dvec3(0, 0, -1));
}

TEST(Camera, SinePathsSwingAQuarterOfTheLateralSize) {
  const auto offset = [](const std::string& path, int i) {
    return camera_at(spec("path_sin_" + path, i, 8), slab, 60).eye -
           camera_at(spec("path_" + path, i, 8), slab, 60).eye;
  };
  expect_near(offset("x", 2), {0, 0, 13.0 / 4}, 1e-13);
  expect_near(offset("y", 2), {40.0 / 4, 0, 0}, 1e-13);
  expect_near(offset("z", 2), {40.0 / 4, 0, 0}, 1e-13);
  expect_near(offset("z", 6), {-40.0 / 4, 0, 0}, 1e-13);
  expect_near(offset("z", 4), {0, 0, 0}, 1e-13);
}

TEST(Camera, DiagonalsRunFromOutsideACornerToTheCentre) {
  const dvec3 centre(10, 5.5, 6.5);
  const auto check = [&](const std::string& path, const dvec3& signs) {
    const Camera first = camera_at(spec(path, 0, 4), slab, 60);
    const dvec3 along = glm::normalize(dvec3(40, 1, 13) * signs);
    expect_near(first.forward, along, 1e-14);
    const double start = glm::length(dvec3(20, 0.5, 6.5)) + 20 * std::sqrt(3);
    expect_near(first.eye, centre - start * along, 1e-12);
    expect_near(camera_at(spec(path, 3, 4), slab, 60).eye, centre - start / 4 * along, 1e-12);
  };
  check("diagonal_xyz", {1, 1, 1});
  check("diagonal_-xyz", {-1, 1, 1});
  check("diagonal_x-yz", {1, -1, 1});
  check("diagonal_xy-z", {1, 1, -1});
}

TEST(Camera, PathsBeginWithAFullViewOfACube) {
  for (const auto path : camera_paths()) {
    const Camera camera = camera_at(spec(path, 0, 36), cube, 60);
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 d = dvec3(corner & 1, corner / 2 & 1, corner / 4) * 2.0 - camera.eye;
      const double reach =
          glm::dot(d, camera.forward) * std::tan(std::numbers::pi / 6) * (1 + 1e-9);
      EXPECT_LE(std::abs(glm::dot(d, camera.up)), reach) << path;
      EXPECT_LE(std::abs(glm::dot(d, camera.right())), reach) << path;
    }
  }
}

TEST(Camera, DepthRangeEnclosesTheBox) {
  for (const char* view : {"orbit_y:1/8", "path_x:0/3", "diagonal_xyz:1/9", "random:5"}) {
    const Camera camera = camera_at(view, slab, 60);
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 p((corner & 1) != 0 ? slab.hi.x : slab.lo.x,
                    (corner & 2) != 0 ? slab.hi.y : slab.lo.y,
                    (corner & 4) != 0 ? slab.hi.z : slab.lo.z);
      const double depth = glm::dot(p - camera.eye, camera.forward);
      EXPECT_LT(depth, camera.far) << view;
      if (!std::string_view(view).starts_with("random")) {
        EXPECT_GT(depth, camera.near) << view;
      }
    }
  }
  EXPECT_GT(camera_at("path_z:9/10", cube, 60).near, 0) << "the eye is inside the box";
}

TEST(Camera, RandomViewsAreSeededAndSeeEnough) {
  double closest = 1e9;
  double farthest = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const std::string view = "random:" + std::to_string(seed);
    const Camera camera = camera_at(view, cube, 60);
    EXPECT_EQ(camera.eye, camera_at(view, cube, 60).eye);
    EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 4e-15);
    const double t = std::tan(std::numbers::pi / 6);
    int seen = 0;
    for (int cell = 0; cell < 512; ++cell) {
      const dvec3 d = (dvec3(cell % 8, cell / 8 % 8, cell / 64) + 0.5) / 4.0 - camera.eye;
      const double depth = glm::dot(d, camera.forward);
      if (depth > 0 && std::abs(glm::dot(d, camera.up)) <= depth * t &&
          std::abs(glm::dot(d, camera.right())) <= depth * t) {
        ++seen;
      }
    }
    EXPECT_GE(seen, 0.3 * 512 - 1) << seed;
    const double distance = glm::length(camera.eye - dvec3(1));
    closest = std::min(closest, distance);
    farthest = std::max(farthest, distance);
  }
  EXPECT_LT(closest, 1.6);
  EXPECT_GT(farthest, 2.7);
  EXPECT_NE(camera_at("random:1", cube, 60).eye, camera_at("random:2", cube, 60).eye);
  EXPECT_NO_THROW((void)camera_at("random:18446744073709551615", cube, 60));
}

// Cameras must be bit-identical on every machine, whichever C library it has.
TEST(Camera, IsBitIdenticalEverywhere) {
  const Camera camera = camera_at("random:7", slab, 60);
  EXPECT_EQ(camera.eye, dvec3(-0x1.15448c0e8efd3p+5, 0x1.7e866b09e47p-1, 0x1.038534fd6ac76p+4));
  EXPECT_EQ(camera_at("orbit_y:1/36", slab, 60).eye,
            dvec3(0x1.37d0212ac3424p+4, 0x1.6p+2, 0x1.e27cb7382cff3p+5));
}

TEST(Camera, ExtremeFieldsOfViewAndBoxesWork) {
  for (const double fov : {0.001, 1.0, 179.0}) {
    for (const Box& box :
         {cube, Box{{0, 0, 0}, {1000, 1, 1}}, Box{{0, 0, 0}, {1e-6, 1e-6, 1e-6}}}) {
      for (const char* view : {"random:1", "random:2", "orbit_x:1/7", "diagonal_x-yz:0/2"}) {
        const Camera camera = camera_at(view, box, fov);
        EXPECT_TRUE(std::isfinite(glm::dot(camera.eye, camera.eye))) << view << fov;
        EXPECT_NEAR(glm::length(camera.ray_direction(0, 0, 1, 1)), 1, 1e-15);
      }
    }
  }
}

TEST(Camera, RejectsEverythingElse) {
  for (const char* bad : {"",
                          "orbit_y",
                          "orbit_y:",
                          "orbit_y:1",
                          "orbit_y:8/8",
                          "orbit_y:-1/8",
                          "orbit_y:1/0",
                          "orbit_y:0/0",
                          "orbit_y:1/8/2",
                          "orbit_y:1.5/8",
                          "orbit_w:1/8",
                          "orbit_:1/8",
                          ":1/8",
                          "path:1/8",
                          "Orbit_y:1/8",
                          "orbit_y: 1/8",
                          "random",
                          "random:",
                          "random:x",
                          "random:-1",
                          "random:18446744073709551616",
                          "random:1/8",
                          "view",
                          "view:",
                          "view:1",
                          "view:1/2",
                          "view:1/2/",
                          "view:1/2/3/4",
                          "view:nan/0/1",
                          "view:361/0/1",
                          "view:0/90.5/1",
                          "view:0/-91/1",
                          "view:0/0/0",
                          "view:0/0/1e4",
                          "view: 0/0/1"}) {
    EXPECT_THROW((void)camera_at(bad, cube, 60), core::InputError) << bad;
  }
  EXPECT_THAT([] { (void)camera_at("orbit_w:1/8", cube, 60); },
              ThrowsMessage<core::InputError>(
                  testing::AllOf(HasSubstr("orbit_w:1/8"), HasSubstr("path_sin_z"))));
}

TEST(Camera, RejectsUnusableBoxesAndFieldsOfView) {
  const double nan = std::nan("");
  for (const double fov : {0.0, -1.0, 180.0, nan}) {
    EXPECT_THROW((void)camera_at("random:1", cube, fov), core::InputError) << fov;
  }
  for (const Box& box :
       {Box{{0, 0, 0}, {1, 0, 1}}, Box{{0, 0, 0}, {1, 1, nan}}, Box{{0, 0, 0}, {-1, 1, 1}}}) {
    EXPECT_THROW((void)camera_at("random:1", box, 60), core::InputError);
  }
}

}  // namespace
}  // namespace triptych::scene
