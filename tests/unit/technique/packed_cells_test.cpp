#include "technique/volume/packed_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "scene/generators.hpp"

namespace triptych::technique {
namespace {

using scene::VoxelFormat;

constexpr std::array all_formats{VoxelFormat::u8, VoxelFormat::u16, VoxelFormat::f32,
                                 VoxelFormat::f16};

scene::VoxelGrid grid_of(VoxelFormat format, std::array<int, 3> size) {
  return scene::encode(scene::generate_volume("mandelbulb", size), format);
}

std::vector<std::byte> packed(const scene::VoxelGrid& grid) {
  std::vector<std::byte> bytes(packed_bytes(grid.size, grid.format));
  fill_packed_cells(grid, 0, bytes);
  return bytes;
}

// Returns whether the k-th voxel of a texel equals the given voxel of the grid, with indices
// clamped to the grid.
bool contains_voxel(const std::vector<std::byte>& bytes, std::size_t texel, std::size_t k,
                    const scene::VoxelGrid& grid, std::array<int, 3> voxel) {
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const int inside = std::clamp(voxel.at(axis), 0, grid.size.at(axis) - 1);
    index = index * static_cast<std::size_t>(grid.size.at(axis)) + static_cast<std::size_t>(inside);
  }
  const std::size_t voxel_bytes = scene::bytes_of(grid.format);
  return std::memcmp(&bytes[texel * packed_texel_bytes(grid.format) + k * voxel_bytes],
                     &grid.data[index * voxel_bytes], voxel_bytes) == 0;
}

TEST(PackedCells, ContainTheSurroundingVoxels) {
  for (const VoxelFormat format : all_formats) {
    const scene::VoxelGrid grid = grid_of(format, {5, 4, 3});
    const auto bytes = packed(grid);
    const std::size_t depth = format == VoxelFormat::f32 ? 1 : 2;
    const int layers = format == VoxelFormat::f32 ? 5 : 4;
    ASSERT_EQ(packed_texels(grid.size, format), 6U * 5U * static_cast<std::size_t>(layers));
    for (int z = 0; z < layers; ++z) {
      for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 6; ++x) {
          const auto texel = static_cast<std::size_t>(x + 6 * (y + 5 * z));
          for (std::size_t k = 0; k < 4 * depth; ++k) {
            const auto bit = [k](unsigned at) { return static_cast<int>(k >> at & 1U); };
            EXPECT_TRUE(contains_voxel(bytes, texel, k, grid,
                                       {x - 1 + bit(0), y - 1 + bit(1), z - 1 + bit(2)}))
                << scene::name_of(format) << ' ' << x << ' ' << y << ' ' << z << ' ' << k;
          }
        }
      }
    }
  }
}

TEST(PackedCells, PartsMatchTheWhole) {
  for (const VoxelFormat format : all_formats) {
    const scene::VoxelGrid grid = grid_of(format, {7, 5, 3});
    const auto whole = packed(grid);
    for (const std::size_t texels : {std::size_t{1}, std::size_t{10}, std::size_t{61}}) {
      const std::size_t part = texels * packed_texel_bytes(format);
      std::vector<std::byte> pieces(whole.size());
      for (std::size_t begin = 0; begin < pieces.size(); begin += part) {
        fill_packed_cells(grid, begin,
                          std::span(pieces).subspan(begin, std::min(part, whole.size() - begin)));
      }
      EXPECT_EQ(pieces, whole);
    }
  }
}

TEST(PackedCells, ExceededLimitsAreReportedWithBothNumbers) {
  scene::VoxelGrid grid{.format = VoxelFormat::u8, .size = {511, 511, 512}};
  constexpr TexelLimit limit{.texels = 134217728, .name = "theLimit"};
  EXPECT_EQ(packed_reason(packed_texels(grid.size, grid.format), {}, limit).value_or(""),
            "sampler=packed needs a texel buffer of 134479872 texels, but theLimit is 134217728");
  grid.size = {511, 511, 511};
  EXPECT_FALSE(packed_reason(packed_texels(grid.size, grid.format), {}, limit));
  EXPECT_TRUE(packed_reason(packed_texels(grid.size, grid.format),
                            {.bricks = 4 * (limit.texels + 1)}, limit));
  EXPECT_TRUE(packed_reason(packed_texels(grid.size, grid.format),
                            {.table = 16 * (limit.texels + 1)}, limit));
}

TEST(PackedCells, AreTheDefaultIfTheyAreFaster) {
  constexpr std::uint64_t many = std::uint64_t{1} << 27U;
  EXPECT_TRUE(packs_by_default({256, 256, 256}, VoxelFormat::u8, true, many));
  EXPECT_TRUE(packs_by_default({96, 96, 96}, VoxelFormat::f32, true, many));
  EXPECT_FALSE(packs_by_default({192, 192, 192}, VoxelFormat::f32, true, many));
  EXPECT_FALSE(packs_by_default({192, 192, 192}, VoxelFormat::u16, true, many));
  EXPECT_TRUE(packs_by_default({192, 192, 192}, VoxelFormat::f32, false, many));
  EXPECT_FALSE(packs_by_default({420, 420, 420}, VoxelFormat::f32, false, many));
  EXPECT_FALSE(packs_by_default({64, 64, 64}, VoxelFormat::u8, true, 65536));
}

}  // namespace
}  // namespace triptych::technique
