#pragma once
#include <array>
#include <memory>

#include "scene/camera.hpp"
#include "scene/particles.hpp"
#include "scene/transfer_function.hpp"

namespace triptych::scene {

// Headlight: the light stands in the eye. With n the unit normal and d the ray's direction,
//   c' = c·(ambient + diffuse·|n·d|),
// opaque. For spheres |n·d| = √(r² − p²)/r, p the distance of the centre from the ray.
struct SphereShading {
  double ambient = 0.3;
  double diffuse = 0.7;
};

// The float nearest to radius·scale.
[[nodiscard]] inline float scaled_radius(float radius, double scale) {
  return static_cast<float>(static_cast<double>(radius) * scale);
}

// Everything that decides the picture, and nothing about how it is computed.
//
// A pixel shows the nearest surface point in front of the eye along the ray through its centre
// (Camera): where a sphere is entered, or, for an eye inside a sphere, where it is left. Nothing is
// cut off by a near or a far plane: camera.near only scales the depth buffer, z = near/Z with Z the
// distance along the view axis (reversed, infinite far plane, 0 where there is nothing); it is a
// power of two so small that no surface that matters lies before it. On a tie in depth the lowest
// id is shown.
struct ParticleScene {
  std::shared_ptr<const ParticleSet> particles;
  TransferFunction intensity_colours;  // for ColourKind::intensity; its opacity is not used
  Camera camera;
  int width = 0;
  int height = 0;
  double radius_scale = 1;  // every radius is scaled_radius(radius, radius_scale)
  SphereShading shading;
  std::array<float, 4> background{0, 0, 0, 0};  // premultiplied

  // The radius that is drawn.
  [[nodiscard]] float radius(std::size_t index) const {
    return scaled_radius(particles->spheres[index][3], radius_scale);
  }
};

// The camera of the `camera` factor for these particles (camera_at over bounding_box), with `near`
// as ParticleScene wants it.
[[nodiscard]] Camera particle_camera(std::string_view spec, const ParticleSet& set,
                                     double fov_y_deg);

// The largest power of two not above 2⁻²⁴ of the box's diagonal and of the eye's distance from it
// together.
[[nodiscard]] double depth_scale(const Box& box, const glm::dvec3& eye);

}  // namespace triptych::scene
