// Tests views chosen with the mouse: they behave like all other cameras, and each can be written in
// only one way.

#include "scene/free_view.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scene/camera.hpp"

namespace triptych::scene {
namespace {

const Box brick{{0, 0, 0}, {20, 11, 13}};

FreeView read_back(const FreeView& view) {
  return parse_free_view(camera_of(view).substr(5)).value();
}

TEST(FreeView, IsOnTheOrbitAtElevationZero) {
  for (const auto& [view, orbit] :
       {std::pair{"view:45/0/1", "orbit_y:1/8"}, std::pair{"view:270/0/1", "orbit_y:3/4"},
        std::pair{"view:-90/0/1", "orbit_-y:1/4"}}) {
    const Camera free_camera = camera_at(view, brick, 60);
    const Camera orbit_camera = camera_at(orbit, brick, 60);
    EXPECT_EQ(free_camera.eye, orbit_camera.eye) << view;
    EXPECT_EQ(free_camera.forward, orbit_camera.forward) << view;
    EXPECT_EQ(free_camera.up, orbit_camera.up) << view;
    EXPECT_EQ(free_camera.near, orbit_camera.near) << view;
    EXPECT_EQ(free_camera.far, orbit_camera.far) << view;
  }
}

TEST(FreeView, LooksAtTheCentreAndStaysUpright) {
  const glm::dvec3 centre(10, 5.5, 6.5);
  const double radius = glm::length(camera_at("orbit_y:0/1", brick, 60).eye - centre);
  for (const double elevation : {-90.0, -37.5, 0.0, 60.0, 90.0}) {
    const FreeView view{.azimuth_deg = 200, .elevation_deg = elevation, .distance = 0.25};
    const Camera camera = camera_at(camera_of(view), brick, 60);
    EXPECT_NEAR(glm::length(camera.eye - centre), 0.25 * radius, 1e-13);
    EXPECT_NEAR(glm::length(camera.eye + 0.25 * radius * camera.forward - centre), 0, 1e-13);
    EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 1e-15);
    EXPECT_NEAR(glm::length(camera.right()), 1, 1e-15);
    EXPECT_GE(camera.up.y, 0) << elevation;
  }
}

TEST(FreeView, SpellingsRoundTrip) {
  for (const FreeView view :
       {FreeView{0, 0, 1}, FreeView{359.96, -0.04, 0.81}, FreeView{-12.34, 89.96, 0.0012345},
        FreeView{123.45, -90, 12.3456}, FreeView{725, 100, 1e6}}) {
    const std::string text = camera_of(view);
    EXPECT_EQ(camera_of(read_back(view)), text);
    EXPECT_NO_THROW((void)camera_at(text, brick, 60)) << text;
  }
  EXPECT_EQ(camera_of({359.96, -0.04, 0.81}), "view:0/0/0.81");
  EXPECT_EQ(camera_of({-12.34, 89.96, 0.0012345}), "view:347.7/90/0.00123");
  EXPECT_EQ(camera_of({725, 100, 1e6}), "view:5/90/1000");
}

// When a drag begins on a camera path, the image must not jump.
TEST(FreeView, BeginsAtThePositionOfAPath) {
  for (const char* camera : {"orbit_y:1/8", "orbit_y:7/8", "view:12.5/-30/0.4", "path_z:1/3"}) {
    const Camera path = camera_at(camera, Box{}, 60);
    const Camera free = camera_at(camera_of(free_view_near(camera)), Box{}, 60);
    EXPECT_LT(glm::length(path.eye - free.eye), 2e-3) << camera;
    EXPECT_LT(glm::length(path.forward - free.forward), 2e-3) << camera;
  }
}

TEST(FreeView, FollowsTheMouse) {
  const FreeView from{.azimuth_deg = 10, .elevation_deg = 80, .distance = 1};
  EXPECT_DOUBLE_EQ(turned(from, 0.25, 0).azimuth_deg, 325);  // the camera moves to the left
  EXPECT_DOUBLE_EQ(turned(from, 0, -0.5).elevation_deg, -10);
  EXPECT_DOUBLE_EQ(turned(from, 0, 1).elevation_deg, 90);
  EXPECT_DOUBLE_EQ(approached(from, 1).distance, 0.9);
  EXPECT_NEAR(approached(approached(from, 3), -3).distance, 1, 1e-15);
  EXPECT_EQ(approached(from, 1e4).distance, FreeView::nearest);
  EXPECT_EQ(approached(from, -1e4).distance, FreeView::farthest);
}

}  // namespace
}  // namespace triptych::scene
