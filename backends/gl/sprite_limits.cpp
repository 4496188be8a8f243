// Checks the device features and limits that sprites require.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "backends/gl/particle_limits.hpp"
#include "backends/gl/sprites.hpp"

namespace triptych::gl_backend {
namespace {

// The limit on the storage blocks of a stage. A stage uses up to four: the three of storage.glsl,
// and one for the counters.
struct StageBlocks {
  GLenum type;
  GLenum limit;
  const char* name;
};
constexpr std::array<StageBlocks, 5> stage_blocks{{
    {GL_VERTEX_SHADER, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, "GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS"},
    {GL_GEOMETRY_SHADER, GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS,
     "GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS"},
    {GL_TESS_CONTROL_SHADER, GL_MAX_TESS_CONTROL_SHADER_STORAGE_BLOCKS,
     "GL_MAX_TESS_CONTROL_SHADER_STORAGE_BLOCKS"},
    {GL_FRAGMENT_SHADER, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS,
     "GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS"},
    {GL_COMPUTE_SHADER, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS,
     "GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS"},
}};

std::optional<std::string> too_few_blocks(const Api& gl, GLenum type, std::int64_t needed) {
  for (const StageBlocks& each : stage_blocks) {
    if (each.type != type) continue;
    const std::int64_t most = gl.limit(each.limit);
    if (most < needed)
      return fmt::format("needs {} storage blocks, but {} is {}", needed, each.name, most);
  }
  return std::nullopt;
}

std::optional<std::string> stage_unsupported(const Api& gl, const ParticleStage& stage) {
  if (stage.type == GL_TESS_CONTROL_SHADER && !has_tessellation(gl)) {
    return "tessellation shaders need OpenGL 4.0 or GL_ARB_tessellation_shader";
  }
  const bool storage = std::ranges::find(stage.files, "storage.glsl") != stage.files.end();
  return too_few_blocks(gl, stage.type, storage ? 4 : 1);
}

bool reads_storage(const Sprites& sprites) {
  return std::ranges::any_of(sprites, [](const SpriteDraw& draw) { return draw.instanced; });
}

}  // namespace

std::optional<std::string> sprites_unsupported(const Api& gl, const measure::ParticleWork& work,
                                               const Sprites& sprites) {
  if (auto reason = particles_unsupported(gl, work, reads_storage(sprites))) return reason;
  if (gl.VERSION_4_5 == 0 && gl.ARB_clip_control == 0) {
    return "a depth range from 0 to 1 needs OpenGL 4.5 or GL_ARB_clip_control";
  }
  if (gl.VERSION_4_3 == 0 && (gl.ARB_multi_draw_indirect == 0 || gl.ARB_base_instance == 0)) {
    return "drawing each cell with its own draw call needs OpenGL 4.3, or "
           "GL_ARB_multi_draw_indirect together with GL_ARB_base_instance";
  }
  if (work.options.conservative_depth && gl.VERSION_4_2 == 0 && gl.ARB_conservative_depth == 0) {
    return "conservative depth needs OpenGL 4.2 or GL_ARB_conservative_depth";
  }
  for (const SpriteDraw& draw : sprites) {
    for (const ParticleStage& stage : draw.stages) {
      if (auto lack = stage_unsupported(gl, stage)) return lack;
    }
  }
  return too_few_blocks(gl, GL_FRAGMENT_SHADER, 1);
}

}  // namespace triptych::gl_backend
