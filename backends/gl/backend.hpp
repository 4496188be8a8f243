#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// OpenGL 3.3 core and later without a window: through EGL (surfaceless, or on an EGL device) and
// through OSMesa, both of which are found at run time. If TRIPTYCH_GL_DEBUG=1 is set in the
// environment, contexts are debug contexts, and every error message of the driver becomes an
// ApiError of the call that caused it.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::gl_backend
