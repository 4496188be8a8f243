#pragma once
#include <functional>
#include <map>
#include <string>

#include "backends/vulkan/vulkan.hpp"

namespace triptych::vulkan_backend {

// The pipelines of an open device, each built once for all that is prepared on it. A
// VkPipelineCache would leave that to the driver, and Mesa's lavapipe keeps nothing in one: there
// building is most of what a short frame costs.
class Pipelines {
 public:
  using Make = std::function<vk::raii::Pipeline()>;

  // The one made for this key before, else `make`'s; it lives as long as the device. The key has to
  // say all that a pipeline is made of, its layout included: a pipeline goes with every layout that
  // is defined in the same way.
  [[nodiscard]] vk::Pipeline get(const std::string& key, const Make& make);

 private:
  std::map<std::string, vk::raii::Pipeline> made_;
};

}  // namespace triptych::vulkan_backend
