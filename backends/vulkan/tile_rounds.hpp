#pragma once
// How `tiles` goes through the cells: in rounds, front to back.

#include <cstdint>
#include <span>
#include <vector>

namespace triptych::vulkan_backend {

// What a cell's particles need at most; mirrors tiles_measure.comp.glsl.
struct CellNeed {
  std::uint32_t pixels = 0;   // of its small spheres' rectangles
  std::uint32_t entries = 0;  // of its large ones in tiles
};

struct TileRound {
  std::uint32_t first_cell = 0;
  std::uint32_t cells = 0;
  std::uint64_t entries = 0;
};

// The first rounds cover the picture about once each, further ones half as often as all before
// them: a tile hides what lies behind it once all its pixels are covered, which takes several
// layers of spheres, and rounds cost little. None has more than `most_entries` unless a single cell
// has.
[[nodiscard]] std::vector<TileRound> divide_into_rounds(std::span<const CellNeed> needs,
                                                        std::uint64_t pixels,
                                                        std::uint64_t most_entries);

}  // namespace triptych::vulkan_backend
