#pragma once
// Voxels as Sampler::packed reads them: cell by cell, so that one load brings what a position lies
// between, where a sampler or a shader makes eight.

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

// Cell (x, y, z) lies between voxels x−1 and x, y−1 and y, z−1 and z, clamped to the edge: there is
// one more of them per axis than voxels. Texel x + row·(y + column·z) of a buffer holds it, where
// row and column are the cells along x and y:
//   u8   two words, the lower and the upper z, of four voxels each: (x−1, y−1) in the lowest byte,
//        (x, y−1), (x−1, y), (x, y)
//   u16  four words, two for each z, of two voxels each, in the same order
//   f16  as u16
//   f32  four words for the lower z; those for the upper z are the lower ones of the next layer, of
//        which there is one more
// That is eight times the voxels of u8, u16 and f16, four times those of f32.
[[nodiscard]] std::uint64_t packed_texels(const std::array<int, 3>& size,
                                          scene::VoxelFormat format);
[[nodiscard]] std::size_t packed_texel_bytes(scene::VoxelFormat format);
[[nodiscard]] std::uint64_t packed_bytes(const std::array<int, 3>& size, scene::VoxelFormat format);

// TRI_VOXEL_BITS of packed.glsl: bits of an integer or float; −16: of a half.
[[nodiscard]] int voxel_bits(scene::VoxelFormat format);

// Writes the bytes from `begin` on; whole texels.
void fill_packed_cells(const scene::VoxelGrid& grid, std::size_t begin, std::span<std::byte> out);

// How many texels of a buffer a device can read; `name` is that of the limit.
struct TexelLimit {
  std::uint64_t texels = 0;
  std::string_view name;
};
// Why such a device cannot draw with Sampler::packed, which reads cells, so many texels, bricks and
// the quadrature's table as texels; empty where it can.
[[nodiscard]] std::optional<std::string> packed_reason(std::uint64_t cells,
                                                       const RaycastBuffers& buffers,
                                                       const TexelLimit& most);

// Whether it is what a device that computes on the processor is fastest with, which filters by
// eight gathers: where the cells are at most a gigabyte, and one filtered value a sample is not all
// that is asked for, or they take but twice what a filter that is exact reads (u8), or stay in the
// caches.
[[nodiscard]] bool packs_by_default(const std::array<int, 3>& size, scene::VoxelFormat format,
                                    bool filter_suffices, std::uint64_t most_texels);

}  // namespace triptych::technique
