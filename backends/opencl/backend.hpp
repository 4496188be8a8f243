#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::opencl_backend {

// OpenCL 1.2 and later, on every platform and device that the ICD loader lists.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::opencl_backend
