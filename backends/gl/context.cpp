#include "backends/gl/context.hpp"

#include <cstdlib>
#include <string_view>

namespace triptych::gl_backend {

void Context::load(GLADloadfunc load_function, bool debug) {
  gl_ = std::make_unique<Api>(load_function);
  if (debug) gl_->collect_messages();
  const char* labels = std::getenv("TRIPTYCH_LABELS");
  if (labels != nullptr && std::string_view(labels) == "1") gl_->label_all();
  // Uses Vulkan's conventions: y = -1 is the first row of a target, and depth runs from 0 to 1.
  if (gl_->ClipControl != nullptr) gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->check("glClipControl");
}

}  // namespace triptych::gl_backend
