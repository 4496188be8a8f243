#pragma once
// Predicts how many additional fragments sprites produce on a device that rounds vertex positions
// to a coarse grid. Sprites are made larger on such a device, so that they cover their spheres even
// after rounding.

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Returns the number of pixels, summed over all spheres, that a square sprite covers only because
// it has grown by `growth` pixels on each side (technique::sprite_growth). The square is
// perpendicular to the ray through the sphere's centre. In world space, it grows by the length of
// `growth` pixels at the sphere's depth. Away from the middle of the image, a length in the radial
// direction covers 1/cos θ times as many pixels, where θ is the angle between the ray and the view
// axis. The result is therefore much larger than if every edge moved by only `growth` pixels. With
// culling, a device draws fewer additional fragments than this.
[[nodiscard]] double fragments_of_growth(const scene::ParticleScene& scene, double growth);

}  // namespace triptych::particles_suite
