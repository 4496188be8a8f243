#pragma once
// Reads what a driver reports about compiled pipelines (VK_KHR_pipeline_executable_properties).

#include <vector>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// Returns the code of pipelines that were created during a capture. Throws vk::SystemError, and
// core::NotSupported if the driver reports nothing about any of them.
[[nodiscard]] measure::Compiled code_of(const Gpu& gpu,
                                        const std::vector<Pipelines::Captured>& pipelines);

}  // namespace triptych::vulkan_backend
