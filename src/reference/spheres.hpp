#pragma once
// The truth for particles: every pixel's ray against the spheres in double precision, nearest
// surface point, lowest id on a tie (scene/particle_scene.hpp says what a pixel shows). Shares no
// code with the techniques.

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "scene/particle_scene.hpp"

namespace triptych::reference {

// What the arithmetic of a device may do wrong; derived where the suite states it
// (suites/particles/tolerance.hpp).
struct SphereErrorModel {
  // A pixel is certain when its id stays the same for every ray within this distance of its centre,
  // in pixels, and no other surface is as near as the bounds on depth.
  double margin_px = 1.0 / 256;
  double lateral_px = 0;        // how far a device's ray may be off, in pixels
  double lateral_relative = 0;  // and its sphere's centre, across the ray, relative to its radius
  double depth_relative = 0;    // of Z, relative to (distance of the centre + radius)
  double colour_relative = 0;   // of each channel, relative to full scale
};

struct SphereTruth {
  int width = 0;
  int height = 0;
  std::vector<double> rgba;           // as core::Image, top row first
  std::vector<double> depth;          // Z, +inf for none
  std::vector<std::uint32_t> ids;     // core::Image::no_particle for none
  std::vector<double> bound;          // per pixel, of any channel: covers what any ray within
                                      // margin_px may show where the pixel is not certain
  std::vector<double> depth_bound;    // of Z; +inf where the pixel is not certain
  std::vector<std::uint8_t> certain;  // 1 or 0
  double coverage = 0;                // share of pixels that show a particle

  [[nodiscard]] core::Image image() const;  // rounded to float, with depth and ids
  // The bound in all four channels, rounded up; its depth is the bound on Z, its ids are 0 where
  // the id must be right and no_particle where it may differ.
  [[nodiscard]] core::Image bound_image() const;
};

// The result does not depend on `threads` (0: as many as there are). Throws InputError for a scene
// without particles' data or pixels.
[[nodiscard]] SphereTruth render_spheres(const scene::ParticleScene& scene,
                                         const SphereErrorModel& model = {}, int threads = 0);

// Version of this renderer: changes whenever its pictures may.
inline constexpr const char* spheres_version = "1";

}  // namespace triptych::reference
