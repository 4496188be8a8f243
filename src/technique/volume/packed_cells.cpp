#include "technique/volume/packed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace triptych::technique {
namespace {

std::array<std::uint64_t, 3> cells_of(const std::array<int, 3>& size) {
  std::array<std::uint64_t, 3> cells{};
  std::ranges::transform(size, cells.begin(),
                         [](int voxels) { return static_cast<std::uint64_t>(voxels) + 1; });
  return cells;
}

// Returns the number of voxel layers in a texel.
std::size_t depth_of(scene::VoxelFormat format) {
  return format == scene::VoxelFormat::f32 ? 1 : 2;
}

// These functions return the index of the voxel before or after a face between voxels along an
// axis, clamped to the volume.
std::size_t before(std::size_t face, int voxels) {
  return std::min(face == 0 ? 0 : face - 1, static_cast<std::size_t>(voxels) - 1);
}
std::size_t after(std::size_t face, int voxels) {
  return std::min(face, static_cast<std::size_t>(voxels) - 1);
}

// Fills `out` with the texels from index `texel` on, one row of cells (spaces between neighbouring
// voxel centres) after the other. The size of a voxel is a template parameter, so that memcpy has a
// constant size and is inlined; otherwise, each texel would need eight calls.
template <std::size_t voxel_bytes, std::size_t layers>
void fill_rows(const scene::VoxelGrid& grid, std::size_t texel, std::span<std::byte> out) {
  const auto cells = cells_of(grid.size);
  const auto row_bytes = voxel_bytes * static_cast<std::size_t>(grid.size[0]);
  std::byte* to = out.data();
  while (to != out.data() + out.size()) {
    const std::size_t y = texel / cells[0] % cells[1];
    const std::size_t z = texel / (cells[0] * cells[1]);
    std::array<const std::byte*, 2 * layers> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t row_y = i % 2 == 0 ? before(y, grid.size[1]) : after(y, grid.size[1]);
      const std::size_t row_z = i / 2 == 0 ? before(z, grid.size[2]) : after(z, grid.size[2]);
      rows.at(i) = &grid.data[row_bytes * (row_y + static_cast<std::size_t>(grid.size[1]) * row_z)];
    }
    for (std::size_t x = texel % cells[0]; x < cells[0] && to != out.data() + out.size(); ++x) {
      const std::size_t left = voxel_bytes * before(x, grid.size[0]);
      const std::size_t right = voxel_bytes * after(x, grid.size[0]);
      for (const std::byte* row : rows) {
        std::memcpy(to, row + left, voxel_bytes);
        std::memcpy(to + voxel_bytes, row + right, voxel_bytes);
        to += 2 * voxel_bytes;
      }
      ++texel;
    }
  }
}

}  // namespace

std::uint64_t packed_texels(const std::array<int, 3>& size, scene::VoxelFormat format) {
  const auto cells = cells_of(size);
  return cells[0] * cells[1] * (cells[2] + 2 - depth_of(format));
}

std::size_t packed_texel_bytes(scene::VoxelFormat format) {
  return 4 * depth_of(format) * scene::bytes_of(format);
}

std::uint64_t packed_bytes(const std::array<int, 3>& size, scene::VoxelFormat format) {
  return packed_texels(size, format) * packed_texel_bytes(format);
}

int voxel_bits(scene::VoxelFormat format) {
  const int bits = static_cast<int>(8 * scene::bytes_of(format));
  return format == scene::VoxelFormat::f16 ? -bits : bits;
}

void fill_packed_cells(const scene::VoxelGrid& grid, std::size_t begin, std::span<std::byte> out) {
  const std::size_t texel = begin / packed_texel_bytes(grid.format);
  switch (grid.format) {
    case scene::VoxelFormat::u8:
      return fill_rows<1, 2>(grid, texel, out);
    case scene::VoxelFormat::u16:
    case scene::VoxelFormat::f16:
      return fill_rows<2, 2>(grid, texel, out);
    case scene::VoxelFormat::f32:
      return fill_rows<4, 1>(grid, texel, out);
  }
}

std::optional<std::string> packed_reason(std::uint64_t cells, const RaycastBuffers& buffers,
                                         const TexelLimit& most) {
  constexpr std::uint64_t word = 4;
  const std::uint64_t needed = std::max({cells, buffers.bricks / word, buffers.table / (4 * word)});
  if (needed <= most.texels) return std::nullopt;
  return fmt::format("sampler=packed needs a texel buffer of {} texels, but {} is {}", needed,
                     most.name, most.texels);
}

bool packs_by_default(const std::array<int, 3>& size, scene::VoxelFormat format,
                      bool filter_suffices, std::uint64_t most_texels) {
  constexpr std::uint64_t most = std::uint64_t{1} << 30U;
  constexpr std::uint64_t cached = std::uint64_t{32} << 20U;
  const std::uint64_t bytes = packed_bytes(size, format);
  if (packed_texels(size, format) > most_texels || bytes > most) return false;
  return !filter_suffices || format == scene::VoxelFormat::u8 || bytes <= cached;
}

}  // namespace triptych::technique
