// Draws point sprites. A second draw draws the spheres that exceed the device's largest point as
// screen-aligned quads.
#include <fmt/format.h>

#include "backends/gl/large_points.hpp"
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

Sprites point_sprites(const Api& gl) {
  const double margin = point_margin(gl);
  const std::string largest =
      fmt::format("#define TRI_LARGEST_POINT {:#.9g}\n#define TRI_POINT_MARGIN {:#.9g}\n",
                  largest_point(gl) - margin, margin);
  ParticleStage points{GL_VERTEX_SHADER, {"sprite.glsl", "point.vert.glsl"}, largest};
  ParticleStage quads = instance_stage(gl, "point_large.vert.glsl");
  quads.defines += largest;
  return {{GL_POINTS, false, false, {points}}, {GL_TRIANGLE_STRIP, true, true, {quads}}};
}

}  // namespace

ParticleTechnique point() {
  return sprite_technique<&point_sprites>();
}

}  // namespace triptych::gl_backend
