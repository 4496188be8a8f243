#pragma once
// The rounds in which `tiles` processes the cells (tiles.glsl). A cell is a group of neighbouring
// particles (arrangement.hpp), and a round processes a range of cells. Rounds are computed when a
// scene is prepared.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/particle_scene.hpp"
#include "technique/particles/arrangement.hpp"

namespace triptych::technique {

inline constexpr int tile_edge = 16;  // in pixels; TRI_TILE in tile_grid.glsl
// TRI_SMALL_EDGE in tile_grid.glsl. A sphere is small if both sides of its pixel rectangle have at
// most this length in pixels; otherwise it is large.
inline constexpr int small_edge = 6;

// A range of cells whose spheres are binned together before the tiles are resolved.
struct TileRound {
  std::uint32_t first = 0;
  std::uint32_t cells = 0;
  std::uint64_t entries = 0;  // upper bound on the number of (tile, large sphere) pairs
};

struct TileRounds {
  std::vector<TileRound> rounds;  // the rounds together contain all cells, front to back
  std::uint64_t entries = 0;      // the largest TileRound::entries
  bool small = false;             // whether there may be small spheres
  // Whether the last pass of the frame draws the large spheres, instead of earlier passes. This is
  // the case if there is only one round, and a pixel is drawn at most twice on average.
  bool at_once = false;
  std::uint64_t passes = 0;  // maximum loop iterations per invocation of tiles_bin or tiles_fill

  // Returns whether large spheres are drawn by passes before the last one.
  [[nodiscard]] bool resolved() const noexcept { return entries > 0 && !at_once; }
  // Returns the value of TRI_SPHERES (tile_grid.glsl).
  [[nodiscard]] int spheres() const noexcept {
    return (small ? 1 : 0) | (entries > 0 ? 2 : 0) | (resolved() ? 4 : 0);
  }
};

// Returns the number of work groups, of 64 invocations each, that process a list of up to this many
// particles. If the list is longer than the number of invocations, each invocation processes
// several particles in a loop.
[[nodiscard]] constexpr std::uint32_t list_groups(std::uint64_t particles) noexcept {
  constexpr std::uint64_t most = 256;
  const std::uint64_t groups = (particles + 63) / 64;
  return static_cast<std::uint32_t>(groups < most ? groups : most);
}

// The maximum number of large spheres in a round, unless a single cell has more. It keeps the loop
// over a tile's entries (the large spheres that reach it) below the limit of llvmpipe and lavapipe
// on loop iterations (docs/accuracy.md).
inline constexpr std::uint64_t most_large_spheres = 32000;

// Divides the cells into rounds. Early rounds hide spheres of later rounds, but each round costs a
// pass over all tiles. A round therefore draws about as many pixels as the image has or, if that is
// more, half as many as all previous rounds together. A round has at most `most_cells` cells and,
// unless a single cell has more, at most `most_entries` entries, which are the pairs of a tile and
// a large sphere that reaches this tile.
[[nodiscard]] TileRounds tile_rounds(const scene::ParticleScene& scene,
                                     const Arrangement& arrangement, std::uint32_t most_cells,
                                     std::uint64_t most_entries);

// Returns why a scene with these rounds cannot be drawn, or nullopt if it can be drawn. An
// invocation loops over the tiles of up to 32 spheres, and llvmpipe and lavapipe end long loops
// without an error (technique/volume/long_rays.hpp).
[[nodiscard]] std::optional<std::string> passes_reason(const TileRounds& rounds);

}  // namespace triptych::technique
