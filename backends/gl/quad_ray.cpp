// Ray-aligned quads, made by a geometry shader.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites quad_ray_sprites(const Api& /*gl*/) {
  return from_geometry_stage(false);
}

}  // namespace

ParticleTechnique quad_ray() {
  return sprite_technique<&quad_ray_sprites>();
}

}  // namespace triptych::gl_backend
