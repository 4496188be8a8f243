#pragma once
// Bricks for skipping empty space. Preparing them is not part of any timing.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume_scene.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::technique {

// How a volume is cut into bricks, in voxels.
struct BrickLayout {
  int edge = 8;
  int border = 1;  // voxels beyond a brick's own, which samples inside it may read
  // Bricks begin at voxel centres and not half a voxel before: a brick is edge³ cells of trilinear
  // interpolation, whose own voxels are (edge + 1)³.
  bool of_cells = false;

  bool operator==(const BrickLayout&) const = default;
};

// The layout that keeps skipping from changing the picture, s the step in voxels.
// Skip::bricks: a midpoint sample inside a brick reads at most one voxel beyond its faces, rounding
//   of up to half a voxel included; a preintegrated step whose middle lies inside reads s/2
//   farther: ⌊s/2 + ¾⌋ voxels more, a quarter of a voxel for rounding.
// Skip::distance: leaps make small bricks affordable, and bricks of cells are as tight as bricks
//   can be: a midpoint sample reads their own voxels alone, a preintegrated step ⌈s/2⌉ beyond. What
//   rounding takes across a face reads others with a weight of that rounding, at most 1e-3,
//   which is less than the table entry by which visibility is widened. The edge is 2, and doubled
//   while the map would take more than 128 MiB.
// Quadrature::cells reads a cell's own eight voxels: bricks of cells either way.
// `adapt` (RaycastOptions): shading reads one voxel farther, and what it reads has to lie in the
//   range as well where samples are merged.
[[nodiscard]] BrickLayout brick_layout(const scene::VolumeScene& scene, Skip skip,
                                       double adapt = 0);

[[nodiscard]] std::array<int, 3> brick_counts(const std::array<int, 3>& size,
                                              const BrickLayout& layout);
// Of brick_map, with a word per brick.
[[nodiscard]] std::uint64_t brick_map_bytes(const std::array<int, 3>& size,
                                            const BrickLayout& layout);

// Minimum and maximum normalised value per brick, x fastest, over the brick and its border.
struct BrickRanges {
  std::array<int, 3> counts{};
  std::vector<float> minimum;
  std::vector<float> maximum;
};
[[nodiscard]] BrickRanges brick_ranges(const scene::VoxelGrid& grid, const BrickLayout& layout);

// 1 where the transfer function gives any opacity to a value of the brick's range, widened by one
// table entry on each side; 0 where every sample is fully transparent. O(1) per brick by a prefix
// sum over the table, so a new transfer function needs only this.
[[nodiscard]] std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                                          const scene::TransferFunction& function);

// Whether brick_visibility would say 0 of any. Ends at the first, hence soon where there is any
// empty space: scenes begin with a corner of their box.
[[nodiscard]] bool any_brick_is_empty(const scene::VolumeScene& scene, const BrickLayout& layout);

}  // namespace triptych::technique
