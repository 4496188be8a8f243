#include "backends/vulkan/tile_rounds.hpp"

#include <algorithm>

namespace triptych::vulkan_backend {

std::vector<TileRound> divide_into_rounds(std::span<const CellNeed> needs, std::uint64_t pixels,
                                          std::uint64_t most_entries) {
  constexpr std::uint64_t tile_pixels = std::uint64_t{16} * 16;  // tiles.glsl: TRI_TILE
  // A work group per cell in one dimension of a dispatch, of which every device takes so many.
  constexpr std::uint32_t most_cells = 65535;
  std::vector<TileRound> rounds;
  std::uint64_t covered = 0;  // by all rounds but the last
  std::uint64_t coverage = 0;
  std::uint64_t goal = pixels;
  for (std::uint32_t cell = 0; cell < needs.size(); ++cell) {
    const CellNeed& need = needs[cell];
    const bool full = !rounds.empty() && (coverage - covered >= goal ||
                                          rounds.back().entries + need.entries > most_entries ||
                                          rounds.back().cells == most_cells);
    if (full) {
      covered = coverage;
      goal = std::max(pixels, covered / 2);
    }
    if (rounds.empty() || full) rounds.push_back({.first_cell = cell});
    TileRound& round = rounds.back();
    ++round.cells;
    round.entries += need.entries;
    coverage += need.pixels + tile_pixels * need.entries;
  }
  return rounds;
}

}  // namespace triptych::vulkan_backend
