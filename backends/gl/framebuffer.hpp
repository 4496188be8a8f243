#pragma once
#include "backends/gl/objects.hpp"

namespace triptych::gl_backend {

// Creates a renderbuffer of this format and size.
[[nodiscard]] Renderbuffer pixels(const Api& gl, GLenum format, int width, int height);

// Throws core::ApiError if the bound framebuffer is not complete.
void check_framebuffer(const Api& gl);

// Fills the first colour target of the bound framebuffer with NaN.
void poison_colour(const Api& gl);

}  // namespace triptych::gl_backend
