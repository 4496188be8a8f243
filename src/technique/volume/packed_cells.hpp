#pragma once
// Voxels in the layout that Sampler::packed reads. They are stored cell by cell, so that one load
// returns all voxels around a position, for which other samplers need eight loads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/volume.hpp"
#include "technique/volume/raycast_buffers.hpp"

namespace triptych::technique {

// Cell (x, y, z) is between the voxels x−1 and x, y−1 and y, z−1 and z, clamped to the edge. Along
// each axis there is one more cell than voxels. The cell is texel x + row·(y + column·z) of a
// buffer, where row and column are the numbers of cells along x and y. A texel contains
//   u8   two words, for the lower and the upper z, with four voxels each: (x−1, y−1) in the lowest
//        byte, then (x, y−1), (x−1, y), (x, y)
//   u16  four words, two for each z, with two voxels each, in the same order
//   f16  the same as u16
//   f32  four words for the lower z. Those for the upper z are the lower ones of the next layer, so
//        there is one more layer.
// This needs eight times the memory of the voxels for u8, u16 and f16, and four times for f32.
[[nodiscard]] std::uint64_t packed_texels(const std::array<int, 3>& size,
                                          scene::VoxelFormat format);
[[nodiscard]] std::size_t packed_texel_bytes(scene::VoxelFormat format);
[[nodiscard]] std::uint64_t packed_bytes(const std::array<int, 3>& size, scene::VoxelFormat format);

// TRI_VOXEL_BITS of packed.glsl: the number of bits of an integer or float, or −16 for half floats.
[[nodiscard]] int voxel_bits(scene::VoxelFormat format);

// Writes the bytes from `begin` on. `out` consists of whole texels.
void fill_packed_cells(const scene::VoxelGrid& grid, std::size_t begin, std::span<std::byte> out);

// The largest number of texels that a device can read from a buffer. `name` is the name of that
// limit.
struct TexelLimit {
  std::uint64_t texels = 0;
  std::string_view name;
};
// The reason why a device cannot draw with Sampler::packed, which reads this many cells, bricks and
// entries of the quadrature's table as texels; empty if it can.
[[nodiscard]] std::optional<std::string> packed_reason(std::uint64_t cells,
                                                       const RaycastBuffers& buffers,
                                                       const TexelLimit& most);

// Whether packed cells are the fastest exact sampler of a device that computes on the processor and
// filters by eight gathers. The cells must take at most a gigabyte. In addition, one of these
// conditions must be true: more than one filtered value per sample is needed; the cells take only
// twice the memory that an exact filter reads (u8); or the cells fit into the caches.
[[nodiscard]] bool packs_by_default(const std::array<int, 3>& size, scene::VoxelFormat format,
                                    bool filter_suffices, std::uint64_t most_texels);

}  // namespace triptych::technique
