#pragma once
#include <optional>
#include <string>

#include "backends/gl/api.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Returns the reason why these particles and this image exceed a limit that applies to every
// particle technique; nullopt if they do not. `storage` is true if the particles are read from
// storage blocks.
[[nodiscard]] std::optional<std::string> particles_unsupported(const Api& gl,
                                                               const measure::ParticleWork& work,
                                                               bool storage);

// Returns whether the device supports tessellation shaders.
[[nodiscard]] inline bool has_tessellation(const Api& gl) {
  return gl.VERSION_4_0 != 0 || gl.ARB_tessellation_shader != 0;
}

}  // namespace triptych::gl_backend
