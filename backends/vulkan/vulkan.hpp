#pragma once
// Vulkan-Hpp as this backend uses it: RAII handles that call through a loader found at run time.

#define VK_NO_PROTOTYPES
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS  // designated initialisers
#include <vulkan/vulkan_raii.hpp>
