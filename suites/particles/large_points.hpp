#pragma once
// What is open where a device's points end: a sprite that is larger is a quad there.

#include <map>
#include <string>

#include "scene/particle_scene.hpp"

namespace triptych::particles_suite {

// By the counters' names, against a device that draws all of them as points. `largest`: the largest
// sprite, in pixels, that the device certainly draws as a point.
//   vertices. Four for one.
//   fragments, discarded ones. A point is the square around a silhouette's rectangle, and larger by
//     a margin, which drivers have up to a pixel of. A rectangle of w pixels passes between ⌊w⌋ and
//     ⌈w⌉ centres along an axis.
//   who is culled, submitted and drawn, where `occlusion` culls. Quads are drawn first and whole,
//     so that behind them it culls more, of cells and particles as many as there are. Who is seen
//     is not open.
[[nodiscard]] std::map<std::string, double> open_by_quads(const scene::ParticleScene& scene,
                                                          double largest, bool occlusion);

}  // namespace triptych::particles_suite
