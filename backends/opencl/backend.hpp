#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// Creates the backend for OpenCL 1.2 and later. It uses every platform and device that the ICD
// loader lists.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::opencl_backend
