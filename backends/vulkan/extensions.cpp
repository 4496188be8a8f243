#include "backends/vulkan/extensions.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

namespace triptych::vulkan_backend {
namespace {

std::set<std::string, std::less<>> offered_by(const vk::raii::PhysicalDevice& physical) {
  std::set<std::string, std::less<>> names;
  for (const vk::ExtensionProperties& each : physical.enumerateDeviceExtensionProperties()) {
    names.emplace(each.extensionName.data());
  }
  return names;
}

template <std::size_t N>
bool offers(const std::set<std::string, std::less<>>& offered,
            const std::array<const char*, N>& wanted) {
  return std::ranges::all_of(wanted, [&](const char* name) { return offered.contains(name); });
}

// Each list includes the extensions on which its first extension depends in Vulkan 1.1.
constexpr std::array structure_names{
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME, VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME};
constexpr std::array spirv_1_4_names{VK_KHR_SPIRV_1_4_EXTENSION_NAME,
                                     VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME};

}  // namespace

ExtensionRequest::ExtensionRequest(const vk::raii::PhysicalDevice& physical) {
  const auto offered = offered_by(physical);
  if (!offers(offered, spirv_1_4_names)) return;
  if (offers(offered, structure_names)) request_ray_tracing(physical);
  if (offered.contains(VK_EXT_MESH_SHADER_EXTENSION_NAME)) request_mesh_shaders(physical);
  if (names_.empty()) return;
  for (const char* name : spirv_1_4_names) names_.push_back(name);
}

void ExtensionRequest::request_ray_tracing(const vk::raii::PhysicalDevice& physical) {
  const auto offered = offered_by(physical);
  const bool query = offered.contains(VK_KHR_RAY_QUERY_EXTENSION_NAME);
  const bool pipeline = offered.contains(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
  const auto has =
      physical
          .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceBufferDeviceAddressFeatures,
                        vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
  if (has.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress == VK_FALSE ||
      has.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure ==
          VK_FALSE ||
      !(query || pipeline)) {
    return;
  }
  const auto limits = physical
                          .getProperties2<vk::PhysicalDeviceProperties2,
                                          vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
                          .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
  extensions_.acceleration_structure = true;
  extensions_.scratch_alignment =
      std::max(limits.minAccelerationStructureScratchOffsetAlignment, 1U);
  extensions_.most_boxes = limits.maxPrimitiveCount;
  names_.insert(names_.end(), structure_names.begin(), structure_names.end());
  add(addresses_);
  add(structures_);
  if (query) {
    const auto feature =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceRayQueryFeaturesKHR>()
            .get<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    extensions_.ray_query = feature.rayQuery == VK_TRUE;
    if (extensions_.ray_query) {
      names_.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
      add(queries_);
    }
  }
  if (pipeline) {
    const auto feature = physical
                             .getFeatures2<vk::PhysicalDeviceFeatures2,
                                           vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>()
                             .get<vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>();
    const auto table = physical
                           .getProperties2<vk::PhysicalDeviceProperties2,
                                           vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>()
                           .get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
    extensions_.ray_pipeline = feature.rayTracingPipeline == VK_TRUE;
    extensions_.group_handle_bytes = table.shaderGroupHandleSize;
    extensions_.group_base_alignment = std::max(table.shaderGroupBaseAlignment, 1U);
    if (extensions_.ray_pipeline) {
      names_.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
      add(pipelines_);
    }
  }
}

void ExtensionRequest::request_mesh_shaders(const vk::raii::PhysicalDevice& physical) {
  const auto feature =
      physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceMeshShaderFeaturesEXT>()
          .get<vk::PhysicalDeviceMeshShaderFeaturesEXT>();
  if (feature.meshShader == VK_FALSE || feature.taskShader == VK_FALSE) return;
  const auto limits = physical
                          .getProperties2<vk::PhysicalDeviceProperties2,
                                          vk::PhysicalDeviceMeshShaderPropertiesEXT>()
                          .get<vk::PhysicalDeviceMeshShaderPropertiesEXT>();
  extensions_.mesh_shader = true;
  extensions_.mesh_vertices = limits.maxMeshOutputVertices;
  extensions_.mesh_primitives = limits.maxMeshOutputPrimitives;
  extensions_.mesh_invocations = limits.maxMeshWorkGroupInvocations;
  extensions_.task_groups = limits.maxTaskWorkGroupCount[0];
  names_.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
  add(meshes_);
}

}  // namespace triptych::vulkan_backend
