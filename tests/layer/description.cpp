#include "tests/layer/description.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "tests/layer/chain.hpp"
#include "tests/layer/change.hpp"

namespace triptych::layer {
namespace {

template <class Member>
using Named = std::pair<std::string_view, Member>;
using Limits = VkPhysicalDeviceLimits;
using Features = VkPhysicalDeviceFeatures;

constexpr std::array<Named<std::uint32_t Limits::*>, 14> numbers{{
    {"maxImageDimension1D", &Limits::maxImageDimension1D},
    {"maxImageDimension2D", &Limits::maxImageDimension2D},
    {"maxImageDimension3D", &Limits::maxImageDimension3D},
    {"maxStorageBufferRange", &Limits::maxStorageBufferRange},
    {"maxUniformBufferRange", &Limits::maxUniformBufferRange},
    {"maxComputeSharedMemorySize", &Limits::maxComputeSharedMemorySize},
    {"maxComputeWorkGroupInvocations", &Limits::maxComputeWorkGroupInvocations},
    {"maxPerStageDescriptorStorageBuffers", &Limits::maxPerStageDescriptorStorageBuffers},
    {"maxPerStageResources", &Limits::maxPerStageResources},
    {"maxDescriptorSetStorageBuffers", &Limits::maxDescriptorSetStorageBuffers},
    {"maxTessellationGenerationLevel", &Limits::maxTessellationGenerationLevel},
    {"maxDrawIndirectCount", &Limits::maxDrawIndirectCount},
    {"subPixelPrecisionBits", &Limits::subPixelPrecisionBits},
    {"subTexelPrecisionBits", &Limits::subTexelPrecisionBits},
}};

constexpr std::array<Named<VkBool32 Features::*>, 9> features_named{{
    {"geometryShader", &Features::geometryShader},
    {"tessellationShader", &Features::tessellationShader},
    {"multiDrawIndirect", &Features::multiDrawIndirect},
    {"drawIndirectFirstInstance", &Features::drawIndirectFirstInstance},
    {"largePoints", &Features::largePoints},
    {"pipelineStatisticsQuery", &Features::pipelineStatisticsQuery},
    {"vertexPipelineStoresAndAtomics", &Features::vertexPipelineStoresAndAtomics},
    {"fragmentStoresAndAtomics", &Features::fragmentStoresAndAtomics},
    {"shaderFloat64", &Features::shaderFloat64},
}};

// The other names that TRIPTYCH_LAYER may contain. Special code implements them, either in this
// file or in memory.cpp and queues.cpp.
constexpr std::array<std::string_view, 15> others{
    "maxComputeWorkGroupSize", "maxComputeWorkGroupCount",
    "maxFramebufferWidth",     "pointSizeRange",
    "pointSizeGranularity",    "timestampComputeAndGraphics",
    "timestampValidBits",      "graphicsQueue",
    "computeFamilyFirst",      "linearFilter",
    "hostVisibleDeviceLocal",  "floatDepth",
    "memoryHeapSize",          "emptyHeap",
    "maxMemoryAllocationSize"};

VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice physical,
                                      VkPhysicalDeviceProperties* properties) {
  next<PFN_vkGetPhysicalDeviceProperties>(physical, "vkGetPhysicalDeviceProperties")(physical,
                                                                                     properties);
  lower(properties->limits);
}

// Gives the device a name for which there are no baselines. If a fault is simulated, changes only
// the driver version, to one for which there are no baselines.
void rename(VkPhysicalDeviceDriverProperties& driver) {
  const std::string& name = changes().front().name;
  if (!known_limit(name)) {
    driver.driverInfo[name.copy(driver.driverInfo, VK_MAX_DRIVER_INFO_SIZE - 1)] = '\0';
    return;
  }
  driver.driverID = {};
  constexpr std::string_view layer = "layer";
  driver.driverName[layer.copy(driver.driverName, layer.size())] = '\0';
}

VKAPI_ATTR void VKAPI_CALL properties2(VkPhysicalDevice physical,
                                       VkPhysicalDeviceProperties2* properties) {
  next<PFN_vkGetPhysicalDeviceProperties2>(physical, "vkGetPhysicalDeviceProperties2")(physical,
                                                                                       properties);
  lower(properties->properties.limits);
  for (auto* each = static_cast<VkBaseOutStructure*>(properties->pNext); each != nullptr;
       each = each->pNext) {
    if (is_requested("maxMemoryAllocationSize") &&
        each->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES) {
      reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(each)->maxMemoryAllocationSize =
          requested_number("maxMemoryAllocationSize");
    }
    if (each->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES) continue;
    rename(*reinterpret_cast<VkPhysicalDeviceDriverProperties*>(each));
  }
}

VKAPI_ATTR void VKAPI_CALL features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures* features) {
  next<PFN_vkGetPhysicalDeviceFeatures>(physical, "vkGetPhysicalDeviceFeatures")(physical,
                                                                                 features);
  lower(*features);
}

VKAPI_ATTR void VKAPI_CALL features2(VkPhysicalDevice physical,
                                     VkPhysicalDeviceFeatures2* features) {
  next<PFN_vkGetPhysicalDeviceFeatures2>(physical, "vkGetPhysicalDeviceFeatures2")(physical,
                                                                                   features);
  lower(features->features);
}

// Implements two of the names in `others`: `linearFilter` removes linear filtering from
// single-channel formats, which volumes use, and `floatDepth` removes D32_SFLOAT, which a device
// that supports X8_D24_UNORM_PACK32 need not support.
VKAPI_ATTR void VKAPI_CALL format_properties(VkPhysicalDevice physical, VkFormat format,
                                             VkFormatProperties* properties) {
  next<PFN_vkGetPhysicalDeviceFormatProperties>(physical, "vkGetPhysicalDeviceFormatProperties")(
      physical, format, properties);
  const bool single = format == VK_FORMAT_R8_UNORM || format == VK_FORMAT_R16_UNORM ||
                      format == VK_FORMAT_R32_SFLOAT;
  if (is_requested("linearFilter") && single) {
    properties->optimalTilingFeatures &=
        ~VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT};
  }
  if (is_requested("floatDepth") && format == VK_FORMAT_D32_SFLOAT)
    properties->optimalTilingFeatures = 0;
}

VKAPI_ATTR VkResult VKAPI_CALL image_properties(VkPhysicalDevice physical, VkFormat format,
                                                VkImageType type, VkImageTiling tiling,
                                                VkImageUsageFlags usage, VkImageCreateFlags flags,
                                                VkImageFormatProperties* properties) {
  const VkResult result = next<PFN_vkGetPhysicalDeviceImageFormatProperties>(
      physical, "vkGetPhysicalDeviceImageFormatProperties")(physical, format, type, tiling, usage,
                                                            flags, properties);
  const std::array names{"maxImageDimension1D", "maxImageDimension2D", "maxImageDimension3D"};
  const char* const name = names.at(static_cast<std::size_t>(type));
  if (is_requested(name)) {
    for (std::uint32_t* side : {&properties->maxExtent.width, &properties->maxExtent.height,
                                &properties->maxExtent.depth}) {
      *side = std::min(*side, requested_number(name));
    }
  }
  return result;
}

}  // namespace

bool known_limit(std::string_view name) {
  return std::ranges::find(numbers, name, &Named<std::uint32_t Limits::*>::first) !=
             numbers.end() ||
         std::ranges::find(features_named, name, &Named<VkBool32 Features::*>::first) !=
             features_named.end() ||
         std::ranges::find(others, name) != others.end();
}

void lower(VkPhysicalDeviceLimits& limits) {
  for (const auto& [name, limit] : numbers) {
    if (is_requested(name)) limits.*limit = requested_number(name);
  }
  if (is_requested("maxComputeWorkGroupSize")) {
    for (std::uint32_t& side : limits.maxComputeWorkGroupSize)
      side = requested_number("maxComputeWorkGroupSize");
  }
  if (is_requested("maxComputeWorkGroupCount")) {
    for (std::uint32_t& side : limits.maxComputeWorkGroupCount)
      side = requested_number("maxComputeWorkGroupCount");
  }
  if (is_requested("maxFramebufferWidth")) {
    limits.maxFramebufferWidth = limits.maxFramebufferHeight =
        requested_number("maxFramebufferWidth");
  }
  if (is_requested("pointSizeRange")) {
    limits.pointSizeRange[1] = static_cast<float>(requested_value("pointSizeRange"));
  }
  if (is_requested("pointSizeGranularity")) {
    limits.pointSizeGranularity = static_cast<float>(requested_value("pointSizeGranularity"));
  }
  if (is_requested("timestampComputeAndGraphics") || is_requested("timestampValidBits")) {
    limits.timestampComputeAndGraphics = VK_FALSE;
  }
}

void lower(VkPhysicalDeviceFeatures& features) {
  for (const auto& [name, feature] : features_named) {
    if (is_requested(name)) features.*feature = VK_FALSE;
  }
}

bool enables_hidden(const VkPhysicalDeviceFeatures& features) {
  return std::ranges::any_of(features_named, [&](const auto& each) {
    return is_requested(each.first) && features.*each.second == VK_TRUE;
  });
}

std::span<const Hook> description_hooks() {
  static const std::array hooks{
      hook("", "vkGetPhysicalDeviceProperties", &properties),
      hook("", "vkGetPhysicalDeviceProperties2", &properties2),
      hook("", "vkGetPhysicalDeviceFeatures", &features),
      hook("", "vkGetPhysicalDeviceFeatures2", &features2),
      hook("", "vkGetPhysicalDeviceFormatProperties", &format_properties),
      hook("", "vkGetPhysicalDeviceImageFormatProperties", &image_properties)};
  return hooks;
}

}  // namespace triptych::layer
