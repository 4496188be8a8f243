#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "backends/gl/program.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// The compile-time constants of the shared particle shaders (technique/particles).
struct ParticleConstants {
  scene::ColourKind colour = scene::ColourKind::rgba8;
  bool transfer_at_pixel = false;
  bool ray_at_vertex = false;
  bool conservative_depth = false;
  technique::ParticleFault fault = technique::ParticleFault::none;
  bool count = false;
};
[[nodiscard]] ParticleConstants particle_constants(const measure::ParticleWork& work);

// One stage of a program. Its source code consists of the files that every stage includes, followed
// by `files` from technique/particles, the last of which contains main(). `defines` are complete
// lines.
struct ParticleStage {
  GLenum type = GL_VERTEX_SHADER;
  std::vector<std::string_view> files;
  std::string defines;
};
[[nodiscard]] std::vector<Stage> particle_stages(const Api& gl, const ParticleConstants& constants,
                                                 const std::vector<ParticleStage>& stages);

}  // namespace triptych::gl_backend
