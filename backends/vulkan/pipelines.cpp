#include "backends/vulkan/pipelines.hpp"

namespace triptych::vulkan_backend {

vk::Pipeline Pipelines::get(const std::string& key, const Make& make) {
  auto made = made_.find(key);
  if (made == made_.end()) made = made_.emplace(key, make()).first;
  return *made->second;
}

}  // namespace triptych::vulkan_backend
