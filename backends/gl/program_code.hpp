#pragma once
// Drivers report the code of the programs that they link in messages of KHR_debug. Mesa's shader-db
// reads the same messages.

#include <span>

#include "backends/gl/api.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Throws core::NotSupported if the messages report nothing.
[[nodiscard]] measure::Compiled code_of(std::span<const Api::Report> reports);

}  // namespace triptych::gl_backend
