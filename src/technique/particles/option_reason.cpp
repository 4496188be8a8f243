#include "technique/particles/option_reason.hpp"

#include <fmt/format.h>

#include "technique/catalogue.hpp"

namespace triptych::technique {
namespace {

std::optional<std::string> fault_of_sprites(const Technique& technique,
                                            const ParticleOptions& options,
                                            SpriteRasterizer rasterizer) {
  const bool tiles = technique.method == Method::tiles;
  const bool in_tiles = tiles || rasterizer == SpriteRasterizer::tiles;
  switch (options.fault) {
    case ParticleFault::wrong_sense:
      // The technique `tiles` always rejects hidden spheres by the depth of their front, regardless
      // of the option conservative_depth.
      if (tiles || options.conservative_depth) return std::nullopt;
      return "the injected fault wrong_sense requires conservative_depth=on, because otherwise no "
             "fragment is rejected early";
    case ParticleFault::culled_visible:
      if (options.culling != Culling::none) return std::nullopt;
      return "the injected fault culled_visible requires culling=frustum or culling=occlusion";
    case ParticleFault::lost_at_border:
      if (in_tiles) return std::nullopt;
      return "the injected fault lost_at_border requires tiles, but here the API's rasterizer "
             "determines which pixels a sprite covers";
    case ParticleFault::missing_barrier:
      if (rasterizer == SpriteRasterizer::tiles) return std::nullopt;
      return "the injected fault missing_barrier requires work-group barriers, but this technique "
             "uses none with this API";
    case ParticleFault::small_box:
      return "the injected fault small_box requires a hierarchy of boxes, which only ray "
             "techniques use";
    case ParticleFault::none:
    case ParticleFault::small_sprite:
    case ParticleFault::unresolved_ties:
    case ParticleFault::reversed_depth:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<std::string> fault_of_rays(ParticleFault fault) {
  switch (fault) {
    case ParticleFault::small_sprite:
      return "the injected fault small_sprite requires sprites, but ray techniques draw none";
    case ParticleFault::culled_visible:
      return "the injected fault culled_visible requires culling, but the factor culling has no "
             "effect on ray techniques";
    case ParticleFault::lost_at_border:
      return "the injected fault lost_at_border requires tiles, but ray techniques use none";
    case ParticleFault::missing_barrier:
      return "the injected fault missing_barrier requires work-group barriers, but ray techniques "
             "use none";
    case ParticleFault::none:
    case ParticleFault::unresolved_ties:
    case ParticleFault::reversed_depth:
    case ParticleFault::wrong_sense:
    case ParticleFault::small_box:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> option_reason(std::string_view id, const ParticleOptions& options,
                                         SpriteRasterizer rasterizer) {
  const Technique& technique = technique::technique(id);
  if (options.ray == ComputedAt::vertex) {
    if (technique.vertices == Vertices::one) {
      return fmt::format("{} supports only ray=pixel, because it draws one vertex per sphere", id);
    }
    if (technique.vertices == Vertices::none) {
      return fmt::format("{} supports only ray=pixel, because it draws no vertices", id);
    }
  }
  if (technique.uses_corners && options.corners < 4) {
    return fmt::format("corners={} is too small; the minimum is 4", options.corners);
  }
  if (technique.method == Method::rays) return fault_of_rays(options.fault);
  if (options.structure != Structure::built_once) {
    return fmt::format(
        "{} supports only structure=static, because it has no hierarchy to refit or rebuild", id);
  }
  return fault_of_sprites(technique, options, rasterizer);
}

}  // namespace triptych::technique
