// Stress scenes that test the geometry of one sphere or a few spheres.

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "suites/particles/stress_maker.hpp"
#include "suites/particles/stress_scenes.hpp"

namespace triptych::particles_suite {
namespace {

double fov_of(double height, double distance) {
  return 2 * std::atan(height / (2 * distance)) * 180 / std::numbers::pi;
}

// Adds a sphere of radius 1 at the origin, and a small sphere that sticks out of it.
void add_pair(StressMaker& maker) {
  maker.add({0, 0, 0}, 1);
  maker.add({1.2, 0.3, 0.1}, 0.2);
}

}  // namespace

// All lengths are multiplied by the same power of two. Such a multiplication commutes with
// rounding, so the image must not change.
StressScene stress_scale(std::string_view variant, scene::ColourKind colour) {
  const double scale = variant == "small" ? 0x1.0p-20 : variant == "large" ? 0x1.0p20 : 1.0;
  StressMaker maker(colour, camera_looking_at(scale * 5.0 * oblique(), {0, 0, 0}, 40), stress_side,
                    stress_side);
  maker.add({0, 0, 0}, scale);
  maker.add(scale * glm::dvec3{1.2, 0.3, 0.1}, 0.2 * scale);
  maker.add(scale * glm::dvec3{-0.9, 0.8, 0.7}, 0.6 * scale);
  maker.add(scale * glm::dvec3{0.4, -1.1, 1.3}, 0.01 * scale);
  return maker.take();
}

// Two small spheres, seen from far away. Their silhouettes are fully visible and do not overlap, so
// the image does not depend on their depths, which floats cannot resolve at this distance.
StressScene stress_far(std::string_view variant, scene::ColourKind colour) {
  constexpr int larger_side = 160;
  const double distance = number_in<double>(variant);
  const scene::Camera camera =
      camera_looking_at(distance * oblique(), {0, 0, 0}, fov_of(5, distance));
  StressMaker maker(colour, camera, larger_side, larger_side);
  maker.add({0, 0, 0}, 1);
  maker.add(1.7 * camera.right() + 1.1 * camera.up, 0.6);
  return maker.take();
}

StressScene stress_giant(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({1, 2, 7}, {0, 0, 0}, 60), stress_side, stress_side);
  maker.add({0, 0, 0}, 1);
  maker.add({0, -10001, 0}, 10000);
  maker.add({2.5, 0, -1}, 1);
  return maker.take();
}

StressScene stress_inside(std::string_view variant, scene::ColourKind colour) {
  glm::dvec3 eye{0, 0, 0};
  if (variant == "off_centre") eye = {0.3, 0.2, 0.1};
  if (variant == "under_surface") eye = 0.9999 * oblique();
  StressMaker maker(colour, camera_looking_at(eye, eye + glm::dvec3{0.7, 0.2, -2.1}, 90),
                    stress_side, stress_side);
  add_pair(maker);
  maker.add({0.5, 0.15, -0.6}, 0.15);  // also inside the large sphere, in front of its shell
  maker.add({0.9, 0.3, -2.5}, 0.8);    // outside, hidden by the shell
  return maker.take();
}

// The eye is just above the ground, a sphere of radius 1, and looks along its tangent, so that the
// horizon (the silhouette of the ground) crosses the image.
StressScene stress_skimming(std::string_view variant, scene::ColourKind colour) {
  const double distance = number_in<double>(variant);
  const glm::dvec3 up = oblique();
  const glm::dvec3 ahead = glm::normalize(glm::cross(up, glm::dvec3{0, 1, 0}));
  scene::Camera camera = camera_looking_at(distance * up, distance * up + ahead, 100);
  camera.up = up;
  StressMaker maker(colour, camera, stress_side, stress_side);
  maker.add({0, 0, 0}, 1);
  // These spheres are half sunk into the ground. Some of them are in front of the horizon, others
  // behind it.
  for (const double angle : {0.004, 0.014, 0.1, 0.5}) {
    const glm::dvec3 foot = std::cos(angle) * up + std::sin(angle) * ahead;
    maker.add(foot + 0.3 * angle * camera.right(), 0.2 * angle);
  }
  return maker.take();
}

StressScene stress_near_plane(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0, 0, -1}, 110), stress_side,
                    stress_side);
  maker.add({1.3, 0.2, -0.1}, 1);
  maker.add({-0.9, -0.5, -0.3}, 0.7);
  maker.add({0.1, 1.2, -0.4}, 0.8);
  maker.add({0.02, -0.03, -0.05}, 0.04);  // nearly touches the eye
  maker.add({0, 0, -6}, 2);
  return maker.take();
}

StressScene stress_behind(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0, 0, -1}, 150), stress_side,
                    stress_side);
  maker.add({1.5, 0.1, 0.3}, 1.4);
  maker.add({-0.5, -1.2, 0.2}, 1.1);
  maker.add({0.2, 0.1, 3}, 2.5);  // completely behind the eye
  maker.add({0, 0.3, -3}, 1);
  return maker.take();
}

StressScene stress_wide(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0.3, 0.2, 0.1}, {-1, 0.4, -2}, 150), stress_side,
                    stress_side);
  for (const double x : {7.0, stress_side - 5.0}) {
    for (const double y : {6.0, stress_side - 8.0}) maker.add_at(x, y, 1, 6);
  }
  maker.add_at(stress_side / 2.0, stress_side / 2.0, 1.5, 5);
  return maker.take();
}

// Nine spheres have their centres on the edges, on the corners and in the middle of the image. Two
// more spheres have their centres outside the image: one of them reaches one pixel into the image,
// and the other one ends one pixel before its edge.
StressScene stress_edges(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({2, 1, 4}, {0, 0, 0}, 50), stress_side, stress_side);
  for (const double x : {0.0, stress_side / 2.0, 1.0 * stress_side}) {
    for (const double y : {0.0, stress_side / 2.0, 1.0 * stress_side})
      maker.add_at(x, y, 3 + 0.01 * x, 9);
  }
  maker.add_at(-11, 25, 4, 12);
  maker.add_at(stress_side + 9, 25, 4, 8);
  return maker.take();
}

// All radii are a hundredth of a pixel. The spheres at the centre of every eighth pixel of every
// eighth row are visible. All other spheres are about four pixels away from them, on pixel corners,
// where no ray hits them.
StressScene stress_subpixel(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at(oblique(), {0, 0, 0}, 60), stress_side, stress_side);
  for (int y = 4; y < stress_side; y += 8) {
    for (int x = 4; x < stress_side; x += 8) {
      maker.add_at(x + 0.5, y + 0.5, 1, 0.01);
      maker.add_at(x + 4.0, y + 4.0, 1, 0.01);
    }
  }
  return maker.take();
}

// Seven spheres of the same apparent size, because their radii are proportional to their distances.
// Each sphere overlaps the next sphere, which is ten times as far away.
StressScene stress_depth_range(std::string_view, scene::ColourKind colour) {
  StressMaker maker(colour, camera_looking_at({0, 0, 0}, {0.3, -0.1, -1}, 60), stress_side,
                    stress_side);
  double depth = 1e-3;
  for (int i = 0; i < 7; ++i, depth *= 10) {
    maker.add_at(14 + 11.3 * i, 46 + (i % 2 == 0 ? 3.7 : -2.9), depth, 12);
  }
  return maker.take();
}

}  // namespace triptych::particles_suite
