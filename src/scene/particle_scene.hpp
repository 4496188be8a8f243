#pragma once
#include <array>
#include <memory>

#include "scene/camera.hpp"
#include "scene/particles.hpp"
#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Shading with the light at the eye. With the unit normal n and the ray direction d, an opaque
// surface of colour c is drawn with the colour
//   c' = c·(ambient + diffuse·|n·d|).
// For spheres, |n·d| = √(r² − p²)/r, where r is the radius and p the distance of the centre from
// the ray.
struct SphereShading {
  double ambient = 0.3;
  double diffuse = 0.7;
};

// Returns the float nearest to radius·scale.
[[nodiscard]] inline float scaled_radius(float radius, double scale) {
  return static_cast<float>(static_cast<double>(radius) * scale);
}

// Everything that determines the image, independent of the technique that draws it. A pixel shows
// the nearest surface point in front of the eye along the ray through the pixel's centre (see
// Camera). This is the point at which the ray enters a sphere or, if the eye is inside the sphere,
// the point at which it leaves the sphere. The near and far planes do not clip anything.
// camera.near only scales the depth buffer: z = near/Z, where Z is the distance along the view axis
// (reversed depth with an infinite far plane; 0 if there is no surface). camera.near is a power of
// two that is small enough for all relevant surfaces to be farther away. If two depths are equal,
// the particle with the lower id is visible.
struct ParticleScene {
  std::shared_ptr<const ParticleSet> particles;
  TransferFunction intensity_colours;  // for ColourKind::intensity; its opacity is not used
  Camera camera;
  int width = 0;
  int height = 0;
  double radius_scale = 1;  // particles are drawn with scaled_radius(radius, radius_scale)
  SphereShading shading;
  std::array<float, 4> background{0, 0, 0, 0};  // premultiplied

  // Returns the radius with which a particle is drawn.
  [[nodiscard]] float radius(std::size_t index) const {
    return scaled_radius(particles->spheres[index][3], radius_scale);
  }
};

// Returns the camera that `spec`, a level (value) of the factor (setting) `camera`, describes for
// these particles. It is the camera that camera_at() returns for their bounding_box(), except that
// `near` is chosen as ParticleScene requires.
[[nodiscard]] Camera particle_camera(std::string_view spec, const ParticleSet& set,
                                     double fov_y_deg);

// Returns the largest power of two that does not exceed 2⁻²⁴ times the sum of the box's diagonal
// and the eye's distance from the box.
[[nodiscard]] double depth_scale(const Box& box, const glm::dvec3& eye);

}  // namespace triptych::scene
