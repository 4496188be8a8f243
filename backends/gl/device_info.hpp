#pragma once
#include <string>
#include <string_view>

#include "record/record.hpp"

namespace triptych::gl_backend {

struct Api;

// Returns the driver information of the current context. The id is "gl:<driver><suffix>". If
// several devices have this id, the caller must append a number. `suffix` names the window system,
// such as "-egl". Only the id of softpipe through EGL has no suffix.
[[nodiscard]] record::Device device_info(const Api& gl, std::string_view suffix);

// Returns the short driver name for device ids, from the vendor and renderer strings. For a layered
// driver (zink, virgl, ANGLE), returns its own name instead of the name of the driver below it.
[[nodiscard]] std::string driver_name(const std::string& vendor, const std::string& renderer);
// Returns the version in one line. For a layered driver, the line ends with the driver below it.
[[nodiscard]] std::string driver_version(const std::string& version, const std::string& renderer);

// Returns whether the renderer runs on the CPU.
[[nodiscard]] bool is_software(const record::Device& info);

}  // namespace triptych::gl_backend
