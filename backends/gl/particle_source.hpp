#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "backends/gl/program.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// The compile-time constants of the shared sources for particles (technique/particles).
struct ParticleConstants {
  scene::ColourKind colour = scene::ColourKind::rgba8;
  bool transfer_at_pixel = false;
  bool ray_at_vertex = false;
  bool conservative_depth = false;
  technique::ParticleFault fault = technique::ParticleFault::none;
  bool count = false;
};
[[nodiscard]] ParticleConstants particle_constants(const measure::ParticleWork& work);

// One stage of a program: its files from technique/particles, of which the last has main(). They
// follow the files that every stage gets. `defines` are complete lines.
struct ParticleStage {
  GLenum type = GL_VERTEX_SHADER;
  std::vector<std::string_view> files;
  std::string defines;
};
[[nodiscard]] std::vector<Stage> particle_stages(const Api& gl, const ParticleConstants& constants,
                                                 const std::vector<ParticleStage>& stages);

}  // namespace triptych::gl_backend
