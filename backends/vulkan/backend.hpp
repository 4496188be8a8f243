#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// Creates the backend for Vulkan 1.1 and later. It uses a loader that is found at run time. If the
// environment variable TRIPTYCH_VULKAN_VALIDATION is 1, every message from the validation layer
// becomes an ApiError for the call that caused it. The layer then also checks synchronization.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::vulkan_backend
