#pragma once
// The additional fragments due to a coarse vertex grid.

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// The number of pixels, over all spheres, that lie in a ray-aligned square grown by `growth` pixels
// (technique::sprite_growth) and not in the square without growth. The square grows by the length
// in the world that is `growth` pixels at the sphere's depth. Away from the middle of the image a
// length along the radius covers 1/cos θ times as many pixels, with θ the angle from the axis. The
// result is therefore much more than edges that move by `growth`. A device that culls draws fewer.
[[nodiscard]] double fragments_of_growth(const scene::ParticleScene& scene, double growth);

}  // namespace triptych::particles_suite
