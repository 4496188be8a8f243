#include "backends/vulkan/errors.hpp"

#include <string>
#include <string_view>

#include "core/error.hpp"

namespace triptych::vulkan_backend {

void rethrow(const vk::SystemError& error, core::CodePlace place, const std::string& detail) {
  // Vulkan-Hpp's error messages have the form "vk::Queue::submit: ErrorDeviceLost".
  const std::string_view text = error.what();
  const std::string call(text.substr(0, text.find(": ")));
  const auto result = static_cast<vk::Result>(error.code().value());
  if (result == vk::Result::eErrorDeviceLost) {
    throw core::DeviceLost(call, vk::to_string(result), detail, place);
  }
  throw core::ApiError(call, vk::to_string(result), detail, place);
}

}  // namespace triptych::vulkan_backend
