#include "backends/gl/framebuffer.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace triptych::gl_backend {

Renderbuffer pixels(const Api& gl, GLenum format, int width, int height) {
  Renderbuffer buffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
  gl.check("glRenderbufferStorage");
  return buffer;
}

void check_framebuffer(const Api& gl) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw core::ApiError("glCheckFramebufferStatus", fmt::format("{:#06x}", status));
  }
  gl.check("glCheckFramebufferStatus");
}

}  // namespace triptych::gl_backend
