#pragma once
// Bricks for skipping empty space. Preparing them is not part of any timing.

#include <array>
#include <cstdint>
#include <vector>

#include "scene/transfer_function.hpp"
#include "scene/volume.hpp"

namespace triptych::technique {

// Edge of a brick in voxels. Every lattice sample inside a brick reads voxels of the brick and at
// most one voxel beyond its faces.
inline constexpr int brick_edge = 8;

[[nodiscard]] std::array<int, 3> brick_counts(const std::array<int, 3>& size);

// Minimum and maximum normalised value per brick, x fastest, over the brick and a border of one
// voxel: no sample in the brick can leave that range, whatever its rounding (up to half a voxel).
struct BrickRanges {
  std::array<int, 3> counts{};
  std::vector<float> minimum;
  std::vector<float> maximum;
};
[[nodiscard]] BrickRanges brick_ranges(const scene::VoxelGrid& grid);

// 1 where the transfer function gives any opacity to a value of the brick's range, widened by one
// table entry on each side; 0 where every sample is fully transparent. O(1) per brick by a prefix
// sum over the table, so a new transfer function needs only this.
[[nodiscard]] std::vector<std::uint32_t> brick_visibility(const BrickRanges& ranges,
                                                          const scene::TransferFunction& function);

}  // namespace triptych::technique
