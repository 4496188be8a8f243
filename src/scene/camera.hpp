#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace triptych::scene {

// A pinhole camera in world units, right-handed, y up. Pixel (x, y) of a w×h image, top row first,
// looks along   forward + (2(x+½)/w − 1)·aspect·tan(fov/2)·right + (1 − 2(y+½)/h)·tan(fov/2)·up,
// with right = forward × up and aspect = w/h. forward, up and right are unit and orthogonal.
struct Camera {
  glm::dvec3 eye{0, 0, 0};
  glm::dvec3 forward{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double fov_y_deg = 60;
  double near = 0.1;
  double far = 1000;

  [[nodiscard]] glm::dvec3 right() const;
  // Unit direction of the ray through the centre of pixel (x, y).
  [[nodiscard]] glm::dvec3 ray_direction(int x, int y, int width, int height) const;
};

// tan(fov/2) with the same bits on every machine; std::tan may differ between C libraries.
[[nodiscard]] double tangent_of_half(double fov_y_deg);

// A camera at `eye` that looks at `target`, with its up vector as close to +y as possible. The view
// direction must not be parallel to y.
[[nodiscard]] Camera looking(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg);

struct Box {
  glm::dvec3 lo{0, 0, 0};
  glm::dvec3 hi{1, 1, 1};
};

// The `camera` factor: "PATH:i/n", 0 ≤ i < n, λ = i/n; "random:SEED"; or "view:…" (free_view.hpp).
// With c the box's centre, s its size, L its largest extent and D = (L/2)/tan(fov/2):
// clang-format off
//   orbit_x|y|z      a circle of radius L/2 + D about that axis, at the angle 2πλ, looking at c;
//   orbit_-x|-y|-z   the same the other way round. x and y start on the +z side, z on the +x side, all
//                    with +y up; the up vector turns with the camera, so that it is never along the view.
//   diagonal_xyz     along that diagonal of the box (a minus reverses an axis), from half its length + D
//   diagonal_-xyz    before c straight towards c, reached at λ = 1.
//   diagonal_x-yz, diagonal_xy-z
//   path_x|y|z       along the axis towards its lower end, from half the extent + D beyond c to c at
//                    λ = 1, looking ahead.
//   path_sin_x|y|z   the same, displaced along z, x, x by ¼ of the extent there times sin 2πλ.
//   random:SEED      a random direction, roll, distance (0.3…1.2 of L/2 + D) and target (in the middle
//                    half of the box), drawn again until at least `random_view_coverage` of the centres
//                    of the box's 8×8×8 cells lie inside a frustum of aspect 1.
// clang-format on
// near and far enclose the part of the box that lies in front of the eye. Equal arguments give
// equal bits on every machine. Throws InputError for any other spec, a field of view outside (0,
// 180)° or a box without extent.
[[nodiscard]] Camera camera_at(std::string_view spec, const Box& box, double fov_y_deg);
inline constexpr double random_view_coverage = 0.3;
[[nodiscard]] std::array<std::string_view, 16> camera_paths();

}  // namespace triptych::scene
