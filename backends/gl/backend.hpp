#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Creates the backend for OpenGL 3.3 core and later. It needs no window, because it uses EGL
// (surfaceless or on an EGL device) and OSMesa. Both libraries are loaded at run time. If the
// environment variable TRIPTYCH_GL_DEBUG is 1, contexts are debug contexts, and every error message
// from the driver becomes an ApiError for the call that caused it.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::gl_backend
