#pragma once
#include <string_view>

#include "backends/gl/api.hpp"
#include "record/record.hpp"

namespace triptych::gl_backend {

// What the current context says about itself. The id is "gl:<driver><suffix>", without a number.
// `suffix` names the window system ("-egl"); only softpipe through EGL is called plain
// "gl:softpipe".
[[nodiscard]] record::Device device_info(const Api& gl, std::string_view suffix);

// Whether the renderer runs on the processor.
[[nodiscard]] bool is_software(const record::Device& info);

}  // namespace triptych::gl_backend
