// Screen-aligned quads around the silhouettes, made by a geometry shader.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites quad_screen_sprites(const Api& /*gl*/) {
  return from_geometry_stage(true);
}

}  // namespace

ParticleTechnique quad_screen() {
  return sprite_technique<&quad_screen_sprites>();
}

}  // namespace triptych::gl_backend
