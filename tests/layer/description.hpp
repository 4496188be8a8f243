#pragma once
// Changes the properties that the device reports about itself: one of them is lowered.

#include <vulkan/vulkan_core.h>

#include <string_view>

namespace triptych::layer {

// Whether the layer lowers a limit with this name.
[[nodiscard]] bool known_limit(std::string_view name);

void lower(VkPhysicalDeviceLimits& limits);
void lower(VkPhysicalDeviceFeatures& features);

// Whether an application enables the feature that the layer hides.
[[nodiscard]] bool enables_hidden(const VkPhysicalDeviceFeatures& features);

}  // namespace triptych::layer
