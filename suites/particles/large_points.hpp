#pragma once
// The differences between counters that are allowed because a device has a largest point size: it
// draws a larger sprite as a quad.

#include <map>
#include <string>

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// Allowed differences by counter name, relative to a device that draws all sprites as points.
// `largest` is the largest sprite in pixels that the device certainly draws as a point.
//
//   - vertices: four instead of one.
//   - fragments and discarded ones: a point is the square around a silhouette's rectangle, and
//     larger by a margin, which is up to a pixel in some drivers. A rectangle of w pixels contains
//     between ⌊w⌋ and ⌈w⌉ pixel centres along an axis.
//   - culled, submitted and drawn ones, if `occlusion` culls: quads are drawn first and completely,
//     so that more cells and particles are culled behind them, up to all of them. The visible ones
//     may not differ.
[[nodiscard]] std::map<std::string, double> open_by_quads(const scene::ParticleScene& scene,
                                                          double largest, bool occlusion);

}  // namespace triptych::particles_suite
