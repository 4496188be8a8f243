// Driver faults in the use of state: pipelines and samplers.
#include <array>
#include <cstring>
#include <vector>

#include "tests/layer/chain.hpp"

namespace triptych::layer {
namespace {

using Pipelines = std::span<const VkGraphicsPipelineCreateInfo>;

VkResult make_pipelines(VkDevice device, VkPipelineCache cache,
                        const std::vector<VkGraphicsPipelineCreateInfo>& infos,
                        const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  return next<PFN_vkCreateGraphicsPipelines>(device, "vkCreateGraphicsPipelines")(
      device, cache, static_cast<std::uint32_t>(infos.size()), infos.data(), allocator, pipelines);
}

// Replaces vkCreateGraphicsPipelines. `Corrupt` changes the state `member` of each pipeline.
template <auto member, auto Corrupt>
VKAPI_ATTR VkResult VKAPI_CALL create_corrupted(VkDevice device, VkPipelineCache cache,
                                                std::uint32_t count,
                                                const VkGraphicsPipelineCreateInfo* infos,
                                                const VkAllocationCallbacks* allocator,
                                                VkPipeline* pipelines) {
  using State = std::remove_cvref_t<decltype(*(infos->*member))>;
  std::vector<VkGraphicsPipelineCreateInfo> changed(infos, infos + count);
  std::vector<State> states(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (infos[i].*member == nullptr) continue;
    states[i] = *(infos[i].*member);
    Corrupt(states[i]);
    changed[i].*member = &states[i];
  }
  return make_pipelines(device, cache, changed, allocator, pipelines);
}

// Changes only one pipeline per call, because Triptych creates pipelines one at a time.
void half_pixel(VkPipelineViewportStateCreateInfo& state) {
  static thread_local VkViewport viewport;
  viewport = state.pViewports[0];
  viewport.x += 0.5F;
  state.pViewports = &viewport;
}

void inverted_depth(VkPipelineDepthStencilStateCreateInfo& state) {
  if (state.depthCompareOp == VK_COMPARE_OP_GREATER) state.depthCompareOp = VK_COMPARE_OP_LESS;
}

void no_depth_write(VkPipelineDepthStencilStateCreateInfo& state) {
  state.depthWriteEnable = VK_FALSE;
}

void culled_front(VkPipelineRasterizationStateCreateInfo& state) {
  state.cullMode = VK_CULL_MODE_FRONT_BIT;
}

void culled_back(VkPipelineRasterizationStateCreateInfo& state) {
  state.cullMode = VK_CULL_MODE_BACK_BIT;
}

void lost_alpha(VkPipelineColorBlendStateCreateInfo& state) {
  static thread_local std::array<VkPipelineColorBlendAttachmentState, 8> targets;
  for (std::uint32_t i = 0; i < state.attachmentCount; ++i) {
    targets.at(i) = state.pAttachments[i];
    targets.at(i).colorWriteMask &= ~VkColorComponentFlags{VK_COLOR_COMPONENT_A_BIT};
  }
  state.pAttachments = targets.data();
}

// Ignores specialization constants, so that they keep their default values.
VKAPI_ATTR VkResult VKAPI_CALL unspecialized(VkDevice device, VkPipelineCache cache,
                                             std::uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* allocator,
                                             VkPipeline* pipelines) {
  std::vector<VkComputePipelineCreateInfo> changed(infos, infos + count);
  for (VkComputePipelineCreateInfo& each : changed) each.stage.pSpecializationInfo = nullptr;
  return next<PFN_vkCreateComputePipelines>(device, "vkCreateComputePipelines")(
      device, cache, count, changed.data(), allocator, pipelines);
}

template <auto Corrupt>
VKAPI_ATTR VkResult VKAPI_CALL sampler(VkDevice device, const VkSamplerCreateInfo* info,
                                       const VkAllocationCallbacks* allocator,
                                       VkSampler* sampler_out) {
  VkSamplerCreateInfo changed = *info;
  Corrupt(changed);
  return next<PFN_vkCreateSampler>(device, "vkCreateSampler")(device, &changed, allocator,
                                                              sampler_out);
}

void nearest(VkSamplerCreateInfo& info) {
  info.magFilter = info.minFilter = VK_FILTER_NEAREST;
}

void repeated(VkSamplerCreateInfo& info) {
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

using Info = VkGraphicsPipelineCreateInfo;
constexpr const char* pipelines_command = "vkCreateGraphicsPipelines";

}  // namespace

std::span<const Hook> state_fault_hooks() {
  static const std::array hooks{
      hook("half_pixel", pipelines_command, &create_corrupted<&Info::pViewportState, &half_pixel>),
      hook("inverted_depth", pipelines_command,
           &create_corrupted<&Info::pDepthStencilState, &inverted_depth>),
      hook("no_depth_write", pipelines_command,
           &create_corrupted<&Info::pDepthStencilState, &no_depth_write>),
      hook("culled_front", pipelines_command,
           &create_corrupted<&Info::pRasterizationState, &culled_front>),
      hook("culled_back", pipelines_command,
           &create_corrupted<&Info::pRasterizationState, &culled_back>),
      hook("lost_alpha", pipelines_command,
           &create_corrupted<&Info::pColorBlendState, &lost_alpha>),
      hook("unspecialized", "vkCreateComputePipelines", &unspecialized),
      hook("nearest_filter", "vkCreateSampler", &sampler<&nearest>),
      hook("repeated_edge", "vkCreateSampler", &sampler<&repeated>)};
  return hooks;
}

}  // namespace triptych::layer
