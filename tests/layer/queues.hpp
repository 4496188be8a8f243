#pragma once
// Queue families that the driver does not have.

#include <vulkan/vulkan_core.h>

#include <vector>

namespace triptych::layer {

// The queues of the device, with the families of the driver.
[[nodiscard]] std::vector<VkDeviceQueueCreateInfo> queues_of_driver(const VkDeviceCreateInfo& info);

}  // namespace triptych::layer
