// Ray-aligned quads, made by a tessellation shader.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites quad_tess_sprites(const Api& /*gl*/) {
  return tessellated("quad");
}

}  // namespace

ParticleTechnique quad_tess() {
  return sprite_technique<&quad_tess_sprites>();
}

}  // namespace triptych::gl_backend
