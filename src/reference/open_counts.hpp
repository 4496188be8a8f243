#pragma once
// By how much a raycaster's counters may differ between two devices that are both right: what
// rounding decides, found ray by ray with the bounds that pictures are judged by.

#include <map>
#include <string>

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// The planes at which a raycaster looks whether it may skip, per axis at origin + k·edge voxels.
struct BrickPlanes {
  int edge = 0;  // 0: it skips nothing
  double origin = 0;
};

// By the counters' names (technique::raycast_counters). What is open of a ray:
//   all of it, where it may hit or miss the volume;
//   samples beyond the shortest chord, and those behind the first that may end the ray;
//   whether a sample has opacity, where the least that a device may find is none. Preintegrated, an
//     opacity below 2⁻²⁴ may be none, as 1 − 2⁻ᶻ may be rounded as a difference;
//   to which side of a plane of bricks a sample counts that lies within its error of it: one sample
//   and
//     one brick. A leap's end moves with its begin (its cubes have reaches that differ by no more
//     than the way between them), so two rows of leaps interleave and differ by one at most;
//   which brick lies between two planes that are passed within their error of each other;
//   with quadrature cells, two points for each piece that is shorter than its ends are certain, and
//   four
//     for an extremum within its error of a kink.
[[nodiscard]] std::map<std::string, double> open_counts(const scene::VolumeScene& scene,
                                                        const ErrorModel& model,
                                                        const BrickPlanes& planes, int threads = 0);

}  // namespace triptych::reference
