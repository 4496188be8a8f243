// Polygons with a given number of corners, made by a tessellation shader.
#include <fmt/format.h>

#include "backends/gl/particle_limits.hpp"
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites polygon_tess_sprites(const Api& /*gl*/) {
  return tessellated("polygon");
}

std::optional<std::string> polygon_tess_unsupported(const Api& gl,
                                                    const measure::ParticleWork& work) {
  const int corners = work.options.corners;
  // The longest of the outline's four edges has a quarter of the corners, rounded up.
  const std::int64_t most =
      has_tessellation(gl) ? 4 * gl.limit(GL_MAX_TESS_GEN_LEVEL) : std::int64_t{corners};
  if (corners > most) {
    return fmt::format("polygons have {} corners, but GL_MAX_TESS_GEN_LEVEL allows {}", corners,
                       most);
  }
  return sprites_unsupported(gl, work, polygon_tess_sprites(gl));
}

}  // namespace

ParticleTechnique polygon_tess() {
  return {&polygon_tess_unsupported, sprite_technique<&polygon_tess_sprites>().make};
}

}  // namespace triptych::gl_backend
