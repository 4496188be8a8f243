#pragma once
// Changes what the device reports about itself: lowers its limits and hides its features.

#include <vulkan/vulkan_core.h>

#include <string_view>

namespace triptych::layer {

// Returns whether the layer can lower a limit with this name.
[[nodiscard]] bool known_limit(std::string_view name);

void lower(VkPhysicalDeviceLimits& limits);
void lower(VkPhysicalDeviceFeatures& features);

// Returns whether an application enables the feature that the layer hides.
[[nodiscard]] bool enables_hidden(const VkPhysicalDeviceFeatures& features);

}  // namespace triptych::layer
