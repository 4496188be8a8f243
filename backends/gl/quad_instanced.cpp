// Draws ray-aligned quads, one instance per particle. The vertex shader computes the corners from
// the particle data in storage blocks.
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites quad_instanced_sprites(const Api& gl) {
  return {{GL_TRIANGLE_STRIP, true, false, {instance_stage(gl, "quad_instanced.vert.glsl")}}};
}

}  // namespace

ParticleTechnique quad_instanced() {
  return sprite_technique<&quad_instanced_sprites>();
}

}  // namespace triptych::gl_backend
