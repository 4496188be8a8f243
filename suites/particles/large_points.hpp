#pragma once
// Computes by how much counters may differ on a device that limits the size of points, compared
// with other devices. Such a device draws larger sprites as quads.

#include <map>
#include <string>

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Returns the allowed differences by counter name, compared with a device that draws all sprites as
// points. `largest` is the size in pixels up to which the device is guaranteed to draw a sprite as
// a point.
//
//   - vertices: a quad has four vertices, a point only one.
//   - fragments and fragments_discarded: a point is the square around the rectangle of a
//     silhouette, so it covers more pixels than a quad. It is also larger by a margin, which is up
//     to a pixel in some drivers. A rectangle that is w pixels wide contains between ⌊w⌋ and ⌈w⌉
//     pixel centres along an axis.
//   - all other counters of cells (groups of particles that are culled together), particles and
//     sprites, if `occlusion` is true: quads are drawn first and completely, so more cells and
//     particles can be culled behind them, up to all of them. Only the number of visible particles
//     may not differ.
[[nodiscard]] std::map<std::string, double> open_counts_of_quads(const scene::ParticleScene& scene,
                                                                 double largest, bool occlusion);

}  // namespace triptych::particles_suite
