#include "backends/gl/framebuffer.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "core/error.hpp"
#include "measure/contract/not_drawn.hpp"

namespace triptych::gl_backend {

namespace {

// Returns the size of a pixel in bytes, for the formats of render targets.
std::uint64_t bytes_of(GLenum format) {
  switch (format) {
    case GL_RGBA32F:
      return 16;
    default:
      return 4;  // formats with one channel, and depth formats
  }
}

}  // namespace

Renderbuffer pixels(const Api& gl, GLenum format, int width, int height) {
  Renderbuffer buffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
  gl.check("glRenderbufferStorage");
  buffer.record_memory(gl.memory_ledger.image(bytes_of(format) * static_cast<std::uint64_t>(width) *
                                              static_cast<std::uint64_t>(height)));
  return buffer;
}

void check_framebuffer(const Api& gl) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw core::ApiError("glCheckFramebufferStatus", fmt::format("{:#06x}", status));
  }
  gl.check("glCheckFramebufferStatus");
}

void poison_colour(const Api& gl) {
  constexpr auto none = std::bit_cast<float>(measure::poison_word);
  constexpr std::array values{none, none, none, none};
  gl.ClearBufferfv(GL_COLOR, 0, values.data());
}

}  // namespace triptych::gl_backend
