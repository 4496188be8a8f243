#pragma once
#include <string>
#include <string_view>

#include "record/record.hpp"

namespace triptych::gl_backend {

struct Api;

// The driver information of the current context. The id is "gl:<driver><suffix>", without a number.
// `suffix` names the window system ("-egl"); only softpipe through EGL is called plain
// "gl:softpipe".
[[nodiscard]] record::Device device_info(const Api& gl, std::string_view suffix);

// The short name of a driver in device ids, from its vendor and renderer strings. A driver that is
// layered over another one (zink, virgl, ANGLE) gets its own name.
[[nodiscard]] std::string driver_name(const std::string& vendor, const std::string& renderer);
// One line. For a layered driver it ends with the driver below.
[[nodiscard]] std::string driver_version(const std::string& version, const std::string& renderer);

// Whether the renderer runs on the processor.
[[nodiscard]] bool is_software(const record::Device& info);

}  // namespace triptych::gl_backend
