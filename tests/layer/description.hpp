#pragma once
// The device's report about itself, with one property lowered.

#include <vulkan/vulkan_core.h>

#include <string_view>

namespace triptych::layer {

// Whether the layer lowers a limit with this name.
[[nodiscard]] bool known_limit(std::string_view name);

void lower(VkPhysicalDeviceLimits& limits);
void lower(VkPhysicalDeviceFeatures& features);

// Whether the hidden feature is among the enabled ones.
[[nodiscard]] bool enables_hidden(const VkPhysicalDeviceFeatures& features);

}  // namespace triptych::layer
