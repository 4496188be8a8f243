#pragma once
// When a driver links a program, it reports the generated code in KHR_debug messages. Mesa's
// shader-db reads the same messages.

#include <span>

#include "backends/gl/api.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Throws core::NotSupported if no message contains statistics.
[[nodiscard]] measure::Compiled code_of(std::span<const Api::Report> reports);

}  // namespace triptych::gl_backend
