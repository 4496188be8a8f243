#pragma once
// The reference renderer for particles. It intersects every pixel's ray with the spheres in double
// precision and takes the nearest surface point; on a tie, the lowest id wins
// (scene/particle_scene.hpp defines what a pixel shows). It shares no code with the techniques.

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::reference {

// The errors that the arithmetic of a device may have. The particle suite derives them
// (suites/particles/tolerance.hpp).
struct SphereErrorModel {
  // A pixel is certain if every ray within this distance from its centre, in pixels, hits the same
  // particle, and if no other surface is within the depth bounds.
  double margin_px = 1.0 / 256;
  double lateral_px = 0;  // error of a device's ray in pixels
  // Error of the sphere's centre across the ray, relative to its radius.
  double lateral_relative = 0;
  double depth_relative = 0;   // error of Z, relative to (distance of the centre + radius)
  double colour_relative = 0;  // error of each channel, relative to full scale
};

struct SphereTruth {
  int width = 0;
  int height = 0;
  std::vector<double> rgba;   // as in core::Image, top row first
  std::vector<double> depth;  // Z, the distance along the view axis; +inf if no particle is visible
  std::vector<std::uint32_t> ids;     // core::Image::no_particle if none is visible
  std::vector<double> bound;          // per pixel, for any channel; for an uncertain pixel it
                                      // covers everything that a ray within margin_px may show
  std::vector<double> depth_bound;    // bound on Z; +inf if the pixel is not certain
  std::vector<std::uint8_t> certain;  // 1 or 0
  double coverage = 0;                // share of pixels that show a particle

  [[nodiscard]] core::Image image() const;  // rounded to float, with depth and ids
  // Returns an image with the bound in all four channels, rounded up. Its depth is the bound on Z.
  // Its ids are 0 where the id must be equal, and no_particle where it may differ.
  [[nodiscard]] core::Image bound_image() const;
};

// Renders the scene. The result does not depend on `threads` (0 means one for each hardware
// thread). Throws InputError if the scene has no particle set or no pixels.
[[nodiscard]] SphereTruth render_spheres(const scene::ParticleScene& scene,
                                         const SphereErrorModel& model = {}, int threads = 0);

// The version of this renderer. It changes whenever its images may change.
inline constexpr const char* spheres_version = "1";

}  // namespace triptych::reference
