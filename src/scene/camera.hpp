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

struct Box {
  glm::dvec3 lo{0, 0, 0};
  glm::dvec3 hi{1, 1, 1};
};

// The `camera` factor: "PATH:i/n" with PATH one of orbit_x, orbit_y, orbit_z, orbit_-x, orbit_-y,
// orbit_-z, diagonal_xyz (and the other three diagonals diagonal_-xyz, diagonal_x-yz,
// diagonal_xy-z), path_x, path_y, path_z, path_sin_x, path_sin_y, path_sin_z; 0 ≤ i < n; or
// "random:SEED": a seeded view that is drawn again until at least `random_view_coverage` of the
// box's eight-times-subdivided cells have their centre inside the frustum. Throws InputError for
// anything else.
[[nodiscard]] Camera camera_at(std::string_view spec, const Box& box, double fov_y_deg);
inline constexpr double random_view_coverage = 0.3;
[[nodiscard]] std::array<std::string_view, 16> camera_paths();

}  // namespace triptych::scene
