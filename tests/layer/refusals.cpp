// Rejects API calls that exceed the lowered limits or use a removed feature of the device.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <set>

#include "tests/layer/chain.hpp"
#include "tests/layer/change.hpp"
#include "tests/layer/spirv_needs.hpp"

namespace triptych::layer {
namespace {

std::mutex mutex;
std::map<VkImageView, VkFormat> formats;
std::set<VkSampler> linear;

// Returns whether `used` exceeds the lowered limit, and reports it if so.
bool exceeds(std::string_view limit, std::uint64_t used, std::string_view command) {
  if (!is_requested(limit) || used <= requested_number(limit)) return false;
  refuse(fmt::format("{}: {} exceeds {} = {}", command, used, limit, requested_number(limit)));
  return true;
}

bool lacks(std::string_view feature, bool used, std::string_view command) {
  if (!is_requested(feature) || !used) return false;
  refuse(fmt::format("{}: without {}", command, feature));
  return true;
}

VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* allocator,
                                            VkImage* image) {
  const std::array names{"maxImageDimension1D", "maxImageDimension2D", "maxImageDimension3D"};
  const std::uint32_t longest =
      std::max({info->extent.width, info->extent.height, info->extent.depth});
  if (exceeds(names.at(static_cast<std::size_t>(info->imageType)), longest, "vkCreateImage")) {
    return VK_ERROR_UNKNOWN;
  }
  if (lacks("floatDepth", info->format == VK_FORMAT_D32_SFLOAT, "vkCreateImage")) {
    return VK_ERROR_UNKNOWN;
  }
  return next<PFN_vkCreateImage>(device, "vkCreateImage")(device, info, allocator, image);
}

VKAPI_ATTR VkResult VKAPI_CALL create_view(VkDevice device, const VkImageViewCreateInfo* info,
                                           const VkAllocationCallbacks* allocator,
                                           VkImageView* view) {
  const VkResult result =
      next<PFN_vkCreateImageView>(device, "vkCreateImageView")(device, info, allocator, view);
  const std::lock_guard lock(mutex);
  if (result == VK_SUCCESS) formats[*view] = info->format;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_sampler(VkDevice device, const VkSamplerCreateInfo* info,
                                              const VkAllocationCallbacks* allocator,
                                              VkSampler* sampler) {
  const VkResult result =
      next<PFN_vkCreateSampler>(device, "vkCreateSampler")(device, info, allocator, sampler);
  const std::lock_guard lock(mutex);
  if (info->magFilter == VK_FILTER_LINEAR) {
    linear.insert(*sampler);
  } else {
    linear.erase(*sampler);
  }
  return result;
}

void check_texture(const VkDescriptorImageInfo& info) {
  const std::lock_guard lock(mutex);
  if (!linear.contains(info.sampler)) return;
  const VkFormat format = formats[info.imageView];
  lacks("linearFilter",
        format == VK_FORMAT_R8_UNORM || format == VK_FORMAT_R16_UNORM ||
            format == VK_FORMAT_R32_SFLOAT,
        "vkUpdateDescriptorSets");
}

VKAPI_ATTR void VKAPI_CALL update_sets(VkDevice device, std::uint32_t count,
                                       const VkWriteDescriptorSet* writes, std::uint32_t copies,
                                       const VkCopyDescriptorSet* copied) {
  for (const VkWriteDescriptorSet& each : std::span(writes, count)) {
    if (each.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
      exceeds("maxStorageBufferRange", each.pBufferInfo->range, "vkUpdateDescriptorSets");
    } else if (each.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
      exceeds("maxUniformBufferRange", each.pBufferInfo->range, "vkUpdateDescriptorSets");
    } else if (each.descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
      check_texture(*each.pImageInfo);
    }
  }
  next<PFN_vkUpdateDescriptorSets>(device, "vkUpdateDescriptorSets")(device, count, writes, copies,
                                                                     copied);
}

VKAPI_ATTR VkResult VKAPI_CALL create_set_layout(VkDevice device,
                                                 const VkDescriptorSetLayoutCreateInfo* info,
                                                 const VkAllocationCallbacks* allocator,
                                                 VkDescriptorSetLayout* layout) {
  const std::span bindings(info->pBindings, info->bindingCount);
  std::uint32_t all = 0;
  for (std::uint32_t stage = 1; stage <= VK_SHADER_STAGE_COMPUTE_BIT; stage *= 2) {
    std::uint32_t buffers = 0;
    std::uint32_t resources = 0;
    for (const VkDescriptorSetLayoutBinding& each : bindings) {
      if ((each.stageFlags & stage) == 0) continue;
      const bool storage = each.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      resources += each.descriptorCount;
      buffers += storage ? each.descriptorCount : 0;
    }
    exceeds("maxPerStageDescriptorStorageBuffers", buffers, "vkCreateDescriptorSetLayout");
    exceeds("maxPerStageResources", resources, "vkCreateDescriptorSetLayout");
  }
  for (const VkDescriptorSetLayoutBinding& each : bindings) {
    all += each.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ? each.descriptorCount : 0;
  }
  exceeds("maxDescriptorSetStorageBuffers", all, "vkCreateDescriptorSetLayout");
  return next<PFN_vkCreateDescriptorSetLayout>(device, "vkCreateDescriptorSetLayout")(
      device, info, allocator, layout);
}

bool shader_fits(const ShaderNeeds& needs) {
  constexpr std::string_view command = "vkCreateShaderModule";
  enum Model : std::uint32_t { geometry = 3, fragment, compute };
  const auto has = [&](std::uint32_t capability) {
    return needs.capabilities.contains(capability);
  };
  const bool refused =
      lacks("geometryShader", has(2), command) || lacks("tessellationShader", has(3), command) ||
      lacks("shaderFloat64", has(10), command) ||
      lacks("vertexPipelineStoresAndAtomics", needs.writes_buffers && needs.model <= geometry,
            command) ||
      lacks("fragmentStoresAndAtomics", needs.writes_buffers && needs.model == fragment, command) ||
      exceeds("maxComputeSharedMemorySize", needs.shared_bytes, command) ||
      exceeds("maxComputeWorkGroupInvocations",
              std::uint64_t{needs.group[0]} * needs.group[1] * needs.group[2], command) ||
      exceeds("maxComputeWorkGroupSize", std::ranges::max(needs.group), command);
  return !refused;
}

VKAPI_ATTR VkResult VKAPI_CALL create_shader(VkDevice device, const VkShaderModuleCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkShaderModule* shader) {
  const std::span code(info->pCode, info->codeSize / sizeof(std::uint32_t));
  if (!shader_fits(shader_needs(code))) return VK_ERROR_UNKNOWN;
  return next<PFN_vkCreateShaderModule>(device, "vkCreateShaderModule")(device, info, allocator,
                                                                        shader);
}

VKAPI_ATTR VkResult VKAPI_CALL create_queries(VkDevice device, const VkQueryPoolCreateInfo* info,
                                              const VkAllocationCallbacks* allocator,
                                              VkQueryPool* pool) {
  if (lacks("pipelineStatisticsQuery", info->queryType == VK_QUERY_TYPE_PIPELINE_STATISTICS,
            "vkCreateQueryPool")) {
    return VK_ERROR_UNKNOWN;
  }
  return next<PFN_vkCreateQueryPool>(device, "vkCreateQueryPool")(device, info, allocator, pool);
}

VKAPI_ATTR VkResult VKAPI_CALL create_framebuffer(VkDevice device,
                                                  const VkFramebufferCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator,
                                                  VkFramebuffer* framebuffer) {
  if (exceeds("maxFramebufferWidth", std::max(info->width, info->height), "vkCreateFramebuffer")) {
    return VK_ERROR_UNKNOWN;
  }
  return next<PFN_vkCreateFramebuffer>(device, "vkCreateFramebuffer")(device, info, allocator,
                                                                      framebuffer);
}

VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                                    std::uint32_t z) {
  exceeds("maxComputeWorkGroupCount", std::max({x, y, z}), "vkCmdDispatch");
  next<PFN_vkCmdDispatch>(commands, "vkCmdDispatch")(commands, x, y, z);
}

VKAPI_ATTR void VKAPI_CALL draw_indirect(VkCommandBuffer commands, VkBuffer buffer,
                                         VkDeviceSize offset, std::uint32_t count,
                                         std::uint32_t stride) {
  lacks("multiDrawIndirect", count > 1, "vkCmdDrawIndirect");
  exceeds("maxDrawIndirectCount", count, "vkCmdDrawIndirect");
  next<PFN_vkCmdDrawIndirect>(commands, "vkCmdDrawIndirect")(commands, buffer, offset, count,
                                                             stride);
}

}  // namespace

std::span<const Hook> refusal_hooks() {
  static const std::array hooks{hook("", "vkCreateImage", &create_image),
                                hook("", "vkCreateImageView", &create_view),
                                hook("", "vkCreateSampler", &create_sampler),
                                hook("", "vkUpdateDescriptorSets", &update_sets),
                                hook("", "vkCreateDescriptorSetLayout", &create_set_layout),
                                hook("", "vkCreateShaderModule", &create_shader),
                                hook("", "vkCreateQueryPool", &create_queries),
                                hook("", "vkCreateFramebuffer", &create_framebuffer),
                                hook("", "vkCmdDispatch", &dispatch),
                                hook("", "vkCmdDrawIndirect", &draw_indirect)};
  return hooks;
}

}  // namespace triptych::layer
