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

// The number of voxel layers in a texel.
std::size_t depth_of(scene::VoxelFormat format) {
  return format == scene::VoxelFormat::f32 ? 1 : 2;
}

// Writes the voxels of one texel after the other as bytes.
class Packer {
 public:
  Packer(const scene::VoxelGrid& grid, std::size_t texel)
      : grid_(grid), cells_(cells_of(grid.size)), bytes_(scene::bytes_of(grid.format)) {
    at_ = {texel % cells_[0], texel / cells_[0] % cells_[1], texel / (cells_[0] * cells_[1])};
  }

  void write(std::byte* out) {
    for (std::size_t z = 0; z < depth_of(grid_.format); ++z) {
      for (std::size_t y = 0; y < 2; ++y) {
        const std::size_t row = voxel(1, at_[1] + y) + size(1) * voxel(2, at_[2] + z);
        for (std::size_t x = 0; x < 2; ++x, out += bytes_) {
          std::memcpy(out, &grid_.data[bytes_ * (voxel(0, at_[0] + x) + size(0) * row)], bytes_);
        }
      }
    }
    if (++at_[0] < cells_[0]) return;
    at_[0] = 0;
    if (++at_[1] < cells_[1]) return;
    at_[1] = 0;
    ++at_[2];
  }

 private:
  [[nodiscard]] std::size_t size(std::size_t axis) const {
    return static_cast<std::size_t>(grid_.size.at(axis));
  }
  // The voxel after the i-th face between voxels, clamped.
  [[nodiscard]] std::size_t voxel(std::size_t axis, std::size_t i) const {
    return std::min(i == 0 ? 0 : i - 1, size(axis) - 1);
  }

  const scene::VoxelGrid& grid_;
  std::array<std::uint64_t, 3> cells_;
  std::size_t bytes_;
  std::array<std::size_t, 3> at_{};
};

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
  const std::size_t texel = packed_texel_bytes(grid.format);
  Packer packer(grid, begin / texel);
  for (std::size_t at = 0; at < out.size(); at += texel) packer.write(&out[at]);
}

std::optional<std::string> packed_reason(std::uint64_t cells, const RaycastBuffers& buffers,
                                         const TexelLimit& most) {
  constexpr std::uint64_t word = 4;
  const std::uint64_t needed = std::max({cells, buffers.bricks / word, buffers.table / (4 * word)});
  if (needed <= most.texels) return std::nullopt;
  return fmt::format("sampler packed needs {} texels in one buffer; {} = {}", needed, most.name,
                     most.texels);
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
