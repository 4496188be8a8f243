#include "backends/gl/context.hpp"

namespace triptych::gl_backend {

void Context::load(GLADloadfunc load_function, bool debug) {
  gl_ = std::make_unique<Api>(load_function);
  if (debug) gl_->collect_messages();
  // Vulkan's conventions: y = -1 is the first row of a target, depth runs from 0 to 1.
  if (gl_->ClipControl != nullptr) gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->check("glClipControl");
}

}  // namespace triptych::gl_backend
