#include "technique/particles/option_reason.hpp"

#include <fmt/format.h>

namespace triptych::technique {
namespace {

std::optional<std::string> fault_reason(bool tiles, const ParticleOptions& options,
                                        SpriteRasterizer rasterizer) {
  const bool in_tiles = tiles || rasterizer == SpriteRasterizer::in_tiles;
  switch (options.fault) {
    case ParticleFault::wrong_sense:
      // tiles rejects whole spheres by their front whatever the option says.
      if (tiles || options.conservative_depth) return std::nullopt;
      return "wrong_sense is a fault of conservative depth: without it nothing is rejected early";
    case ParticleFault::culled_visible:
      if (options.culling != Culling::none) return std::nullopt;
      return "culled_visible is a fault of culling";
    case ParticleFault::lost_at_border:
      if (in_tiles) return std::nullopt;
      return "lost_at_border is a fault of tiles: here the rasterizer decides what a sprite covers";
    case ParticleFault::missing_barrier:
      if (rasterizer == SpriteRasterizer::in_tiles) return std::nullopt;
      return "missing_barrier is a fault of work groups that wait for each other: here none does";
    case ParticleFault::none:
    case ParticleFault::small_sprite:
    case ParticleFault::unresolved_ties:
    case ParticleFault::reversed_depth:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> option_reason(std::string_view technique, const ParticleOptions& options,
                                         SpriteRasterizer rasterizer) {
  const bool tiles = technique == "tiles";
  if (options.ray == ComputedAt::vertex) {
    if (technique == "point") return "a point has one vertex: its rays are made per pixel";
    if (tiles) return "tiles have no vertices: rays are made per pixel";
  }
  if (technique == "polygon_tess" && options.corners < 4) {
    return fmt::format("polygons of {} corners; 4 is the least", options.corners);
  }
  return fault_reason(tiles, options, rasterizer);
}

}  // namespace triptych::technique
