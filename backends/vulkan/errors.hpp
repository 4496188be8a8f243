#pragma once
#include <source_location>
#include <utility>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// Throws core::DeviceLost or core::ApiError with the call and the code of `error`.
[[noreturn]] void rethrow(const vk::SystemError& error, std::source_location place);

// Runs `work` and turns Vulkan's errors into ours: what every entry of the contract is wrapped in.
template <class Work>
decltype(auto) translated(Work&& work,
                          std::source_location place = std::source_location::current()) {
  try {
    return std::forward<Work>(work)();
  } catch (const vk::SystemError& error) {
    rethrow(error, place);
  }
}

}  // namespace triptych::vulkan_backend
