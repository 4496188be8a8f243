#pragma once
// Guards for a device that only compiles.

#include <glad/gl.h>

namespace triptych::gl_backend {

// Replaces functions of the context. Those that execute or read back throw core::NotSupported, and
// those that move data move nothing. At most one context of a process can be guarded.
void forbid_execution(GladGLContext& gl);

}  // namespace triptych::gl_backend
