#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/vulkan.hpp"
#include "record/record.hpp"

namespace triptych::vulkan_backend {

struct Candidate {
  vk::raii::PhysicalDevice physical;
  record::Device info;
  std::string reason;  // the reason why it cannot be used; empty if it can
};

// All physical devices in the order of the loader, with ids "vulkan:<driver>". If a driver lists
// several devices, the second one is "#2", and so on. Throws core::ApiError.
[[nodiscard]] std::vector<Candidate> candidates(std::vector<vk::raii::PhysicalDevice> devices);

}  // namespace triptych::vulkan_backend
