#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// OpenGL 3.3 core and later without a window: through EGL (surfaceless, or on an EGL device) and
// through OSMesa, both found at run time. With TRIPTYCH_GL_DEBUG=1 in the environment contexts are
// debug contexts, and every error message of the driver becomes an ApiError of the call it belongs
// to.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::gl_backend
