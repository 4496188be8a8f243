#pragma once
#include <array>
#include <memory>

#include "scene/camera.hpp"
#include "scene/particles.hpp"
#include "scene/transfer_function.hpp"

namespace triptych::scene {

// The light is at the eye. With the unit normal n and the direction d of the ray, an opaque surface
// has the colour
//   c' = c·(ambient + diffuse·|n·d|).
// For spheres, |n·d| = √(r² − p²)/r, where p is the distance of the centre from the ray.
struct SphereShading {
  double ambient = 0.3;
  double diffuse = 0.7;
};

// The float nearest to radius·scale.
[[nodiscard]] inline float scaled_radius(float radius, double scale) {
  return static_cast<float>(static_cast<double>(radius) * scale);
}

// Everything that determines the image, independent of the technique that draws it. A pixel shows
// the nearest surface point in front of the eye along the ray through the pixel's centre (Camera).
// That is where the ray enters a sphere or, if the eye is inside the sphere, where it leaves it.
// Near and far planes do not clip anything. camera.near only scales the depth buffer: z = near/Z,
// where Z is the distance along the view axis (reversed depth with an infinite far plane; 0 if
// there is no surface). camera.near is a power of two, small enough that no relevant surface is
// nearer. If two depths are equal, the particle with the lowest id is visible.
struct ParticleScene {
  std::shared_ptr<const ParticleSet> particles;
  TransferFunction intensity_colours;  // for ColourKind::intensity; its opacity is not used
  Camera camera;
  int width = 0;
  int height = 0;
  double radius_scale = 1;  // every radius is scaled_radius(radius, radius_scale)
  SphereShading shading;
  std::array<float, 4> background{0, 0, 0, 0};  // premultiplied

  // The radius with which a particle is drawn.
  [[nodiscard]] float radius(std::size_t index) const {
    return scaled_radius(particles->spheres[index][3], radius_scale);
  }
};

// The camera that the `camera` factor describes for these particles (camera_at with their
// bounding_box), with `near` as ParticleScene requires it.
[[nodiscard]] Camera particle_camera(std::string_view spec, const ParticleSet& set,
                                     double fov_y_deg);

// The largest power of two that does not exceed 2⁻²⁴ times the sum of the box's diagonal and the
// eye's distance from the box.
[[nodiscard]] double depth_scale(const Box& box, const glm::dvec3& eye);

}  // namespace triptych::scene
