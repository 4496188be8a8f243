#pragma once
// Divides volumes into bricks, which are cubes of voxels that are used to skip empty space. Bricks
// are prepared outside all timed code.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// How a volume is divided into bricks. All lengths are in voxels.
struct BrickLayout {
  int edge = 8;
  int border = 1;  // number of voxels that samples may read beyond the brick
  // Whether bricks begin at voxel centres instead of half a voxel before them. A brick then
  // consists of edge³ cells of trilinear interpolation, whose corners are (edge + 1)³ voxels.
  bool is_cell_aligned = false;

  bool operator==(const BrickLayout&) const = default;
};

// Returns a layout for which skipping does not change the image. s is the step in voxels.
//
//   - Skip::bricks. A midpoint sample inside a brick reads at most one voxel beyond the brick's
//     faces. This includes rounding of up to half a voxel. A preintegrated step whose middle is
//     inside the brick reads s/2 farther: ⌊s/2 + ¾⌋ more voxels, which allows a quarter of a voxel
//     for rounding.
//   - Skip::distance. Bricks can be small, because a ray leaps over many of them at once. They
//     begin at voxel centres (is_cell_aligned), so that a midpoint sample reads only voxels of the
//     brick itself, and a preintegrated step reads ⌈s/2⌉ voxels beyond it. If rounding moves a
//     sample across a face, the voxels behind the face have a weight that is as small as the
//     rounding, at most 1e-3. brick_visibility() widens the range of values by one table entry,
//     which covers this error. The edge is 2 cells. It is doubled until the map takes at most 128
//     MiB.
//   - Quadrature::cells reads only the eight voxels of a cell, so it uses bricks of cells for both
//     kinds of skipping.
//   - `adapt` (RaycastOptions): shading reads one more voxel, which must be included in the range
//     of a brick whose samples may be merged.
[[nodiscard]] BrickLayout brick_layout(const scene::VolumeScene& scene, Skip skip,
                                       double adapt = 0);

[[nodiscard]] std::array<int, 3> brick_counts(const std::array<int, 3>& size,
                                              const BrickLayout& layout);
// Returns the size of brick_map in bytes, with one word for each brick.
[[nodiscard]] std::uint64_t brick_map_bytes(const std::array<int, 3>& size,
                                            const BrickLayout& layout);

// The smallest and largest normalised value of each brick (x fastest), including its border.
struct BrickRanges {
  std::array<int, 3> counts{};
  std::vector<float> minimum;
  std::vector<float> maximum;
};
[[nodiscard]] BrickRanges brick_ranges(const scene::VoxelGrid& grid, const BrickLayout& layout);

// Returns one number for each brick: 1 if the transfer function assigns any opacity to a value in
// the brick's range, widened by one table entry on each side, or 0 if every sample in the brick is
// completely transparent. A prefix sum over the table makes this O(1) for each brick. If only the
// transfer function changes, only this function has to be called again.
[[nodiscard]] std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                                          const scene::TransferFunction& function);

// Returns whether brick_visibility is 0 for any brick. The search stops at the first such brick. If
// the volume contains empty space, the search is usually short, because a corner of the box is
// usually empty.
[[nodiscard]] bool any_brick_is_empty(const scene::VolumeScene& scene, const BrickLayout& layout);

}  // namespace triptych::technique
