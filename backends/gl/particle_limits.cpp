#include "backends/gl/particle_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "backends/gl/compute_pass.hpp"

namespace triptych::gl_backend {

std::optional<std::string> particles_unsupported(const Api& gl, const measure::ParticleWork& work,
                                                 bool storage) {
  if (gl.VERSION_4_3 == 0 && gl.ARB_compute_shader == 0) {
    return "culling and counting need OpenGL 4.3 or GL_ARB_compute_shader";
  }
  if (auto reason = storage_unsupported(gl)) return reason;
  const scene::ParticleScene& scene = work.scene;
  const std::int64_t edge =
      std::min(gl.limit(GL_MAX_RENDERBUFFER_SIZE), gl.limit(GL_MAX_TEXTURE_SIZE));
  if (std::max(scene.width, scene.height) > edge) {
    return fmt::format(
        "the image has {}x{} pixels, but the lower of GL_MAX_RENDERBUFFER_SIZE and "
        "GL_MAX_TEXTURE_SIZE is {}",
        scene.width, scene.height, edge);
  }
  if (storage) {
    const auto needed = static_cast<std::int64_t>(scene.particles->count() * 4 * sizeof(float));
    const std::int64_t most = gl.limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    if (needed > most) {
      return fmt::format(
          "{} particles need a storage block of {} bytes, but GL_MAX_SHADER_STORAGE_BLOCK_SIZE is "
          "{}",
          scene.particles->count(), needed, most);
    }
  }
  return std::nullopt;
}

}  // namespace triptych::gl_backend
