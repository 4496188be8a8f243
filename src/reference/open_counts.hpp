#pragma once
// Computes the largest permitted differences between the raycasting counters of two correct
// devices. Counts that depend on rounding may differ. Each ray is searched for such counts, with
// the same error bounds as for images.

#include <map>
#include <string>

#include "reference/volume.hpp"
#include "scene/volume_scene.hpp"

namespace triptych::reference {

// The planes between bricks, which are cubes of voxels that a raycaster can skip as a whole. Along
// each axis, the planes are at origin + k·edge voxels, for all integers k.
struct BrickPlanes {
  int edge = 0;  // 0 if the raycaster does not skip bricks
  double origin = 0;
};

// Returns the allowed differences by counter name (technique::raycast_counters). For each ray, the
// following may differ between devices:
//
//   - all counts, if rounding decides whether the ray hits the volume;
//   - samples beyond the shortest possible chord, and samples after the first sample at which a
//     device may end the ray;
//   - whether a sample has opacity, if the smallest opacity that it may have on a device is zero.
//     With preintegrated steps, an opacity below 2⁻²⁴ may become zero, because a device may compute
//     the opacity 1 − 2⁻ᶻ of the optical depth z as a difference;
//   - the side of a plane between bricks to which a sample is assigned, if the sample is closer to
//     the plane than its position error. This affects one sample and one brick. It does so even
//     with skip=distance, which leaps over a cube of equal bricks around the current brick: the
//     cubes around two bricks differ in size by at most the distance between these bricks, so the
//     leaps of two devices interleave along the ray, and their numbers differ by at most one;
//   - whether a brick between two planes is visited, if the ray crosses both planes at positions
//     that are equal within their errors;
//   - with quadrature=cells, two points for each piece that is shorter than the uncertainty of its
//     ends, and four points for each extremum of the values that differs from a kink (an entry of
//     the transfer function at which its slope changes) by no more than the error of the values.
[[nodiscard]] std::map<std::string, double> open_counts(const scene::VolumeScene& scene,
                                                        const ErrorModel& model,
                                                        const BrickPlanes& planes, int threads = 0);

}  // namespace triptych::reference
