#pragma once
// The voxel layout of Sampler::packed. Voxels are stored cell by cell, so that one load returns all
// voxels around a position. Other samplers need eight loads.

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
// each axis, there is one more cell than there are voxels. The cell is texel
// x + row·(y + column·z) of a buffer, where `row` and `column` are the numbers of cells along x and
// y. A texel contains
//   u8   two words with four voxels each, first for the lower and then for the upper z: (x−1, y−1)
//        in the lowest byte, then (x, y−1), (x−1, y), (x, y)
//   u16  four words with two voxels each, in the same order: two words for each z
//   f16  the same as u16
//   f32  four words for the lower z. The words for the upper z are those of the next layer, so
//        there is one more layer.
// The buffer takes eight times the memory of the voxels for u8, u16 and f16, and four times their
// memory for f32.
[[nodiscard]] std::uint64_t packed_texels(const std::array<int, 3>& size,
                                          scene::VoxelFormat format);
[[nodiscard]] std::size_t packed_texel_bytes(scene::VoxelFormat format);
[[nodiscard]] std::uint64_t packed_bytes(const std::array<int, 3>& size, scene::VoxelFormat format);

// Returns the value of TRI_VOXEL_BITS in packed.glsl: the number of bits of an integer or float, or
// −16 for half floats.
[[nodiscard]] int voxel_bits(scene::VoxelFormat format);

// Fills `out` with the packed data that begins at byte `begin`. `begin` and the size of `out` are
// multiples of the texel size.
void fill_packed_cells(const scene::VoxelGrid& grid, std::size_t begin, std::span<std::byte> out);

// The maximum number of texels that a device can read from a buffer, and the name of this limit.
struct TexelLimit {
  std::uint64_t texels = 0;
  std::string_view name;
};
// Returns why a device cannot draw with Sampler::packed, which reads this many cells, bricks and
// entries of the quadrature table as texels, or nullopt if it can.
[[nodiscard]] std::optional<std::string> packed_reason(std::uint64_t cells,
                                                       const RaycastBuffers& buffers,
                                                       const TexelLimit& most);

// Returns whether packed cells are the fastest exact sampler of a device that runs on the CPU,
// where a hardware sampler executes eight gather instructions for each filtered value. The cells
// must take at most a gigabyte and at most `most_texels` texels. In addition, one of these
// conditions must hold: each sample needs more than one filtered value (`filter_suffices` is
// false); the cells take only twice the memory that an exact filter reads (u8); or the cells fit
// into the caches.
[[nodiscard]] bool packs_by_default(const std::array<int, 3>& size, scene::VoxelFormat format,
                                    bool filter_suffices, std::uint64_t most_texels);

}  // namespace triptych::technique
