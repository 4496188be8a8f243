#pragma once
#include <memory>

#include "backends/opencl/devices.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// Creates a context and a queue for the device. Throws core::ApiError.
[[nodiscard]] std::unique_ptr<measure::Device> open_device(Found found);

}  // namespace triptych::opencl_backend
