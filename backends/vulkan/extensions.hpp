#pragma once
#include <vector>

#include "backends/vulkan/gpu.hpp"

namespace triptych::vulkan_backend {

// The names and features of the extensions to enable when a device is opened, for techniques that
// need more than Vulkan 1.1. The feature chain points into this object.
class ExtensionRequest {
 public:
  explicit ExtensionRequest(const vk::raii::PhysicalDevice& physical);
  ExtensionRequest(const ExtensionRequest&) = delete;
  ExtensionRequest& operator=(const ExtensionRequest&) = delete;

  [[nodiscard]] const Extensions& extensions() const noexcept { return extensions_; }
  [[nodiscard]] const std::vector<const char*>& names() const noexcept { return names_; }
  // Returns the feature chain for the pNext member of vk::DeviceCreateInfo; null if no extension is
  // requested.
  [[nodiscard]] void* features() const noexcept { return chain_; }

 private:
  template <class Feature>
  void add(Feature& feature) {
    feature.pNext = chain_;
    chain_ = &feature;
  }
  void request_ray_tracing(const vk::raii::PhysicalDevice& physical);
  void request_mesh_shaders(const vk::raii::PhysicalDevice& physical);

  Extensions extensions_;
  std::vector<const char*> names_;
  void* chain_ = nullptr;
  vk::PhysicalDeviceBufferDeviceAddressFeatures addresses_{.bufferDeviceAddress = VK_TRUE};
  vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures_{.accelerationStructure = VK_TRUE};
  vk::PhysicalDeviceRayQueryFeaturesKHR queries_{.rayQuery = VK_TRUE};
  vk::PhysicalDeviceRayTracingPipelineFeaturesKHR pipelines_{.rayTracingPipeline = VK_TRUE};
  vk::PhysicalDeviceMeshShaderFeaturesEXT meshes_{.taskShader = VK_TRUE, .meshShader = VK_TRUE};
};

}  // namespace triptych::vulkan_backend
