#pragma once
#include <memory>

#include "backends/gl/context.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::gl_backend {

// Creates a device from its context. The work that the device prepares must not outlive the device.
// Throws core::ApiError.
[[nodiscard]] std::unique_ptr<measure::Device> make_device(record::Device info,
                                                           std::unique_ptr<Context> context);

}  // namespace triptych::gl_backend
