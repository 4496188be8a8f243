// Point sprites; spheres larger than the device's points on screen-aligned quads, in a second draw.
#include <fmt/format.h>

#include "backends/gl/large_points.hpp"
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"

namespace triptych::gl_backend {
namespace {

// softpipe draws a point of size s as ⌊s⌋ pixels from the whole one next to its lower end: in a
// point of two pixels more, every pixel whose centre lies in the square is drawn.
double margin_of(const Api& gl) {
  return gl.text(GL_RENDERER).starts_with("softpipe") ? 2 : 0;
}

Sprites sprites(const Api& gl) {
  const double margin = margin_of(gl);
  const std::string largest =
      fmt::format("#define TRI_LARGEST_POINT {:.1f}\n#define TRI_POINT_MARGIN {:.1f}\n",
                  largest_point(gl) - margin, margin);
  ParticleStage points{GL_VERTEX_SHADER, {"sprite.glsl", "point.vert.glsl"}, largest};
  ParticleStage quads = instance_stage(gl, "point_large.vert.glsl");
  quads.defines += largest;
  return {{GL_POINTS, false, false, {points}}, {GL_TRIANGLE_STRIP, true, true, {quads}}};
}

}  // namespace

ParticleTechnique point() {
  return sprite_technique<&sprites>();
}

}  // namespace triptych::gl_backend
