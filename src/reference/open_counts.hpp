#pragma once
// The largest difference of a raycaster's counters between two correct devices. Some counts depend
// on rounding. They are found ray by ray with the same bounds as for images.

#include <map>
#include <string>

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// The planes at which a raycaster decides whether it can skip a brick. Along each axis they are at
// origin + k·edge voxels.
struct BrickPlanes {
  int edge = 0;  // 0 if the raycaster does not skip
  double origin = 0;
};

// Allowed differences by counter name (technique::raycast_counters). For each ray, the following
// may differ between devices:
//
//   - all counts, if the ray may hit or miss the volume;
//   - samples beyond the shortest chord, and samples after the first one that may end the ray;
//   - whether a sample has opacity, if the smallest opacity on a device is zero. With preintegrated
//     steps, an opacity below 2⁻²⁴ may become zero, because 1 − 2⁻ᶻ may be computed as a
//     difference;
//   - the side of a plane between bricks on which a sample counts, if the sample is within its
//     error of the plane. This affects one sample and one brick. The end of a leap moves with its
//     beginning, because the sizes of the skipped cubes differ by at most the distance between
//     them. Two sequences of leaps therefore interleave, and their numbers differ by at most one;
//   - the brick between two planes that the ray passes within their error of each other;
//   - with quadrature cells, two points for each piece that is shorter than the uncertainty of its
//     ends, and four points for an extremum within its error of a kink.
[[nodiscard]] std::map<std::string, double> open_counts(const scene::VolumeScene& scene,
                                                        const ErrorModel& model,
                                                        const BrickPlanes& planes, int threads = 0);

}  // namespace triptych::reference
