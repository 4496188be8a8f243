#include "suites/particles/tolerance.hpp"

#include <algorithm>
#include <cmath>

namespace triptych::particles_suite {

reference::SphereErrorModel error_model(const scene::ParticleScene& scene,
                                        technique::ComputedAt ray, int sub_pixel_bits) {
  constexpr double u = 0x1.0p-24;
  const double snapping =
      ray == technique::ComputedAt::vertex ? std::ldexp(1.0, -sub_pixel_bits) : 0;
  const bool looked_up = scene.particles->colour == scene::ColourKind::intensity;
  return {
      .lateral_px = 8 * u * std::max(scene.width, scene.height) + snapping,
      .lateral_relative = 5 * u,
      .depth_relative = 24 * u,
      .colour_relative = looked_up ? 288 * u : 32 * u,
  };
}

}  // namespace triptych::particles_suite
