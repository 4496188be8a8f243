#pragma once
// Queue families that the driver does not have.

#include <vulkan/vulkan_core.h>

#include <vector>

namespace triptych::layer {

// The device's queues by the driver's own families.
[[nodiscard]] std::vector<VkDeviceQueueCreateInfo> queues_of_driver(const VkDeviceCreateInfo& info);

}  // namespace triptych::layer
