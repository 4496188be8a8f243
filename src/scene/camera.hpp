#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace triptych::scene {

// A pinhole camera in a right-handed world space with y up. The ray of pixel (x, y) in a w×h image
// (top row first) has the direction
//   forward + (2(x+½)/w − 1)·aspect·tan(fov/2)·right + (1 − 2(y+½)/h)·tan(fov/2)·up
// with right = forward × up and aspect = w/h. forward, up and right are orthogonal unit vectors.
struct Camera {
  glm::dvec3 eye{0, 0, 0};
  glm::dvec3 forward{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double fov_y_deg = 60;
  double near = 0.1;
  double far = 1000;

  [[nodiscard]] glm::dvec3 right() const;
  // Returns the unit direction of the ray through the centre of pixel (x, y).
  [[nodiscard]] glm::dvec3 ray_direction(int x, int y, int width, int height) const;
};

// Returns tan(fov/2), bit-identical on every machine. std::tan may differ between C libraries.
[[nodiscard]] double tangent_of_half(double fov_y_deg);

// Returns a camera at `eye` that looks at `target`, with its up vector as close to +y as possible.
// The view direction must not be parallel to y.
[[nodiscard]] Camera camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target,
                                       double fov_y_deg);

struct Box {
  glm::dvec3 lo{0, 0, 0};
  glm::dvec3 hi{1, 1, 1};
};

// Returns the camera that a level (value) of the factor (setting) `camera` describes: "PATH:i/n"
// with 0 ≤ i < n, "random:SEED", or "view:…" (free_view.hpp). Let λ = i/n, c the box's centre, L
// its largest extent, and D = (L/2)/tan(fov/2). The paths are:
// clang-format off
//   orbit_x|y|z      a circle of radius L/2 + D about that axis, at the angle 2πλ, looking at c
//   orbit_-x|-y|-z   the same circle in the opposite direction. The orbits about x and y start on the +z side, those about z on
//                    the +x side, all with +y up. The up vector turns with the camera, so it is never parallel to the view.
//   diagonal_xyz     along that diagonal of the box (a minus sign reverses the axis that follows it). The camera starts half
//   diagonal_-xyz    the diagonal's length plus D in front of c, moves straight towards c, and reaches c at λ = 1.
//   diagonal_x-yz, diagonal_xy-z
//   path_x|y|z       along the axis towards its lower end, looking ahead. The camera starts at a distance from c
//                    of half the box's extent along that axis plus D, and reaches c at λ = 1.
//   path_sin_x|y|z   the same path, displaced by ¼·sin(2πλ) of the box's extent: path_sin_x along z, the other two along x
//   random:SEED      a random direction, roll, distance (0.3…1.2 times L/2 + D) and target (in the middle half of the box).
//                    All four are chosen again until at least the fraction `random_view_coverage` of the centres of the box's
//                    8×8×8 cells lies inside a frustum of aspect ratio 1.
// clang-format on
// The near and far planes enclose the part of the box in front of the eye. Equal arguments give
// bit-identical cameras on every machine. Throws InputError for any other `spec`, for a field of
// view outside (0, 180)°, and for a box without extent.
[[nodiscard]] Camera camera_at(std::string_view spec, const Box& box, double fov_y_deg);
inline constexpr double random_view_coverage = 0.3;
[[nodiscard]] std::array<std::string_view, 16> camera_paths();

}  // namespace triptych::scene
