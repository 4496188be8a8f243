// Point sprites; spheres larger than the device's points on screen-aligned quads, in a second draw.
#include <fmt/format.h>

#include "backends/gl/large_points.hpp"
#include "backends/gl/sprites.hpp"
#include "backends/gl/techniques.hpp"
#include "technique/particles/margins.hpp"

namespace triptych::gl_backend {
namespace {

double margin_of(const Api& gl) {
  GLfloat granularity = 0;
  gl.GetFloatv(GL_POINT_SIZE_GRANULARITY, &granularity);
  return technique::point_margin(gl.text(GL_RENDERER), static_cast<double>(granularity)) +
         2 * technique::sprite_growth(gl.sub_pixel_bits());
}

Sprites sprites(const Api& gl) {
  const double margin = margin_of(gl);
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
  return sprite_technique<&sprites>();
}

}  // namespace triptych::gl_backend
