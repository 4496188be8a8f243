#pragma once
#include <memory>

#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// Vulkan 1.1 and later, through the loader found at run time. With TRIPTYCH_VULKAN_VALIDATION=1 in
// the environment every message of the validation layer becomes an ApiError of the call it belongs
// to; the layer then judges synchronization as well.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();

}  // namespace triptych::vulkan_backend
