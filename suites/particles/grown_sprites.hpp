#pragma once
// What a coarse grid of vertices costs in fragments.

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Pixels that lie in a ray-aligned square grown by `growth` pixels (technique::sprite_growth) and
// in none without, over all spheres. The square grows by a length in the world that is `growth`
// pixels at the sphere's depth. Away from the middle of the image a length along the radius covers
// 1/cos θ as many pixels, θ being the angle from the axis: what is open there is far more than
// edges that move by `growth`. Whoever culls has fewer.
[[nodiscard]] double fragments_of_growth(const scene::ParticleScene& scene, double growth);

}  // namespace triptych::particles_suite
