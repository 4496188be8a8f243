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
  std::string reason;  // why the device cannot be used; empty if it can
};

// Returns all physical devices in the loader's order, with ids of the form "vulkan:<driver>". If a
// driver lists several devices, the id of the second one ends with "#2", and so on. Throws
// core::ApiError.
[[nodiscard]] std::vector<Candidate> candidates(std::vector<vk::raii::PhysicalDevice> devices);

}  // namespace triptych::vulkan_backend
