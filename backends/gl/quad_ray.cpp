// Quads across the ray to the centre, made by a geometry shader.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites sprites(const Api& /*gl*/) {
  return from_geometry_stage(false);
}

}  // namespace

ParticleTechnique quad_ray() {
  return sprite_technique<&sprites>();
}

}  // namespace triptych::gl_backend
