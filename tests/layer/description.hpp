#pragma once
// What the device says of itself, with one thing lowered.

#include <vulkan/vulkan_core.h>

#include <string_view>

namespace triptych::layer {

// Whether `name` is one that the layer lowers.
[[nodiscard]] bool known_limit(std::string_view name);

void lower(VkPhysicalDeviceLimits& limits);
void lower(VkPhysicalDeviceFeatures& features);

// Whether the feature that is hidden is among those enabled.
[[nodiscard]] bool enables_hidden(const VkPhysicalDeviceFeatures& features);

}  // namespace triptych::layer
