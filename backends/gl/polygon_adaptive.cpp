// Draws polygons whose number of corners depends on the projected radius. A tessellation shader
// generates them.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites polygon_adaptive_sprites(const Api& /*gl*/) {
  return tessellated("adaptive");
}

}  // namespace

ParticleTechnique polygon_adaptive() {
  return sprite_technique<&polygon_adaptive_sprites>();
}

}  // namespace triptych::gl_backend
