#pragma once
// Bricks, which are used to skip empty space. Preparing them is not part of any timing.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// The division of a volume into bricks, in voxels.
struct BrickLayout {
  int edge = 8;
  int border = 1;  // voxels beyond the brick that its samples may read
  // Whether bricks begin at voxel centres instead of half a voxel before. A brick then consists of
  // edge³ cells of trilinear interpolation and has (edge + 1)³ voxels of its own.
  bool of_cells = false;

  bool operator==(const BrickLayout&) const = default;
};

// The layout with which skipping does not change the image. Below, s is the step in voxels.
//
//   - Skip::bricks. A midpoint sample inside a brick reads at most one voxel beyond the brick's
//     faces, which includes rounding of up to half a voxel. A preintegrated step whose middle is
//     inside reads s/2 farther: ⌊s/2 + ¾⌋ more voxels, with a quarter of a voxel for rounding.
//   - Skip::distance. Leaps make small bricks affordable, and bricks of cells fit as tightly as
//     possible: a midpoint sample reads only voxels of the brick itself, and a preintegrated step
//     reads ⌈s/2⌉ voxels beyond. If rounding moves a sample across a face, the other voxels have a
//     weight as small as that rounding, at most 1e-3, which is covered by the table entry by which
//     visibility is widened. The edge is 2. It is doubled while the map would take more than 128
//     MiB.
//   - Quadrature::cells reads only the eight voxels of a cell, so it uses bricks of cells for both.
//   - `adapt` (RaycastOptions): shading reads one more voxel, which must be included in the range
//     where samples are merged.
[[nodiscard]] BrickLayout brick_layout(const scene::VolumeScene& scene, Skip skip,
                                       double adapt = 0);

[[nodiscard]] std::array<int, 3> brick_counts(const std::array<int, 3>& size,
                                              const BrickLayout& layout);
// The size of brick_map in bytes, with one word for each brick.
[[nodiscard]] std::uint64_t brick_map_bytes(const std::array<int, 3>& size,
                                            const BrickLayout& layout);

// The smallest and largest normalised value of each brick (x fastest), including its border.
struct BrickRanges {
  std::array<int, 3> counts{};
  std::vector<float> minimum;
  std::vector<float> maximum;
};
[[nodiscard]] BrickRanges brick_ranges(const scene::VoxelGrid& grid, const BrickLayout& layout);

// Contains 1 for a brick if the transfer function gives any opacity to a value of the brick's
// range, widened by one table entry on each side, and 0 if every sample is completely transparent.
// A prefix sum over the table makes this O(1) for each brick. Only this has to be repeated for a
// new transfer function.
[[nodiscard]] std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                                          const scene::TransferFunction& function);

// Whether brick_visibility is 0 for any brick. The search stops at the first such brick, which is
// soon found if there is any empty space, because a corner of the box is usually empty.
[[nodiscard]] bool any_brick_is_empty(const scene::VolumeScene& scene, const BrickLayout& layout);

}  // namespace triptych::technique
