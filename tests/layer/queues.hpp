#pragma once
// Simulates queue families that the driver does not have.

#include <vulkan/vulkan_core.h>

#include <vector>

namespace triptych::layer {

// Returns the queues to create, with the driver's own queue family indices.
[[nodiscard]] std::vector<VkDeviceQueueCreateInfo> queues_of_driver(const VkDeviceCreateInfo& info);

}  // namespace triptych::layer
