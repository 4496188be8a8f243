#pragma once
#include <vector>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/features.hpp"

namespace triptych::vulkan_backend {

// Returns the feature probes, each of which checks that the driver executes one feature of the API
// correctly. They keep a reference to the Gpu.
[[nodiscard]] std::vector<measure::FeatureProbe> feature_probes(const Gpu& gpu);

}  // namespace triptych::vulkan_backend
