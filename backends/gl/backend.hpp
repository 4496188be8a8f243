#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// OpenGL 3.3 core and later without a window, through EGL (surfaceless or on an EGL device) and
// through OSMesa. Both libraries are loaded at run time. If the environment variable
// TRIPTYCH_GL_DEBUG is 1, contexts are debug contexts, and every error message from the driver
// becomes an ApiError for the call that caused it.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::gl_backend
