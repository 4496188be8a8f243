#include "backends/gl/particle_source.hpp"

#include <fmt/format.h>

#include "technique/particles/margins.hpp"

namespace triptych::gl_backend {
namespace {

std::string_view depth_promise(const ParticleConstants& constants) {
  if (!constants.conservative_depth) return {};
  return constants.fault == technique::ParticleFault::wrong_sense
             ? "#define TRI_DEPTH_PROMISE depth_greater\n"
             : "#define TRI_DEPTH_PROMISE depth_less\n";
}

// TRI_LINK(n) declares the location of a variable between two stages. It is empty below GL 4.3,
// where shaders are compiled as GLSL 3.30 (program.cpp), which matches such variables by name.
std::string constant_lines(const Api& gl, const ParticleConstants& constants) {
  return fmt::format(
      "#extension GL_ARB_conservative_depth : enable\n"
      "#extension GL_ARB_shader_draw_parameters : enable\n"
      "#define TRI_LINK(n) {}\n#define TRI_COLOUR {}\n#define TRI_TRANSFER_AT_PIXEL {:d}\n"
      "#define TRI_RAY_AT_VERTEX {:d}\n#define TRI_FAULT {}\n#define TRI_COUNT {:d}\n"
      "#define TRI_SPRITE_GROWTH {:#.9g}\n{}",
      gl.at_least(4, 3) ? "layout(location = n)" : "", static_cast<int>(constants.colour),
      int{constants.transfer_at_pixel}, int{constants.ray_at_vertex},
      static_cast<int>(constants.fault), int{constants.count},
      technique::sprite_growth(gl.sub_pixel_bits()), depth_promise(constants));
}

}  // namespace

ParticleConstants particle_constants(const measure::ParticleWork& work) {
  using technique::ComputedAt;
  return {.colour = work.scene.particles->colour,
          .transfer_at_pixel = work.options.transfer == ComputedAt::pixel,
          .ray_at_vertex = work.options.ray == ComputedAt::vertex,
          .conservative_depth = work.options.conservative_depth,
          .fault = work.options.fault,
          .count = false};
}

std::vector<Stage> particle_stages(const Api& gl, const ParticleConstants& constants,
                                   const std::vector<ParticleStage>& stages) {
  std::vector<Stage> sources;
  for (const ParticleStage& stage : stages) {
    std::vector<std::string_view> files{"volume_math.h", "sphere_math.h",
                                        "particles/parameters.glsl", "camera_space.glsl",
                                        "colour.glsl"};
    files.insert(files.end(), stage.files.begin(), stage.files.end());
    sources.push_back(
        shared_stage(gl, stage.type, constant_lines(gl, constants) + stage.defines, files));
  }
  return sources;
}

}  // namespace triptych::gl_backend
