#pragma once
#include <string>
#include <utility>

#include "backends/vulkan/vulkan.hpp"
#include "core/code_place.hpp"

namespace triptych::vulkan_backend {

// Throws core::DeviceLost or core::ApiError with the API call and the code of `error`.
[[noreturn]] void rethrow(const vk::SystemError& error, core::CodePlace place,
                          const std::string& detail = {});

// Runs `work`, and converts errors from Vulkan to core::ApiError or core::DeviceLost. Every
// function of the backend's interface is wrapped in this function.
template <class Work>
decltype(auto) translated(Work&& work, core::CodePlace place = core::CodePlace::current()) {
  try {
    return std::forward<Work>(work)();
  } catch (const vk::SystemError& error) {
    rethrow(error, place);
  }
}

}  // namespace triptych::vulkan_backend
