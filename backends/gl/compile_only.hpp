#pragma once
// Guards for devices that only compile: the driver generates code for a GPU that is not present.

#include <glad/gl.h>

namespace triptych::gl_backend {

// Replaces functions of the context. Functions that execute work or read results throw
// core::NotSupported, and functions that upload data allocate memory without copying. At most one
// context per process can be guarded.
void forbid_execution(GladGLContext& gl);

}  // namespace triptych::gl_backend
