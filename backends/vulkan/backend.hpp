#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// Vulkan 1.1 and later, through the loader that is found at run time. If
// TRIPTYCH_VULKAN_VALIDATION=1 is set in the environment, every message of the validation layer
// becomes an ApiError of the call that caused it. The layer then also checks synchronization.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::vulkan_backend
