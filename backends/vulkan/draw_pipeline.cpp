#include "backends/vulkan/draw_pipeline.hpp"

#include <fmt/format.h>

namespace triptych::vulkan_backend {
namespace {

// Owns the shader modules and the constants to which the stages point.
class Stages {
 public:
  Stages(const Gpu& gpu, const std::vector<DrawStage>& stages, const Specialization& constants)
      : constants_(constants.info()) {
    modules_.reserve(stages.size());
    for (const DrawStage& each : stages) {
      modules_.push_back(make_shader(gpu, each.code));
      infos_.push_back({.stage = each.stage,
                        .module = *modules_.back(),
                        .pName = "main",
                        .pSpecializationInfo = &constants_});
    }
  }
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  [[nodiscard]] const std::vector<vk::PipelineShaderStageCreateInfo>& infos() const {
    return infos_;
  }

 private:
  vk::SpecializationInfo constants_;
  std::vector<vk::raii::ShaderModule> modules_;
  std::vector<vk::PipelineShaderStageCreateInfo> infos_;
};

std::vector<vk::PipelineColorBlendAttachmentState> overwriting(std::uint32_t targets) {
  using enum vk::ColorComponentFlagBits;
  return {targets, {.colorWriteMask = eR | eG | eB | eA}};
}

vk::PipelineDepthStencilStateCreateInfo depth_state(std::optional<vk::CompareOp> compare) {
  const vk::Bool32 on = compare ? VK_TRUE : VK_FALSE;
  return {.depthTestEnable = on,
          .depthWriteEnable = on,
          .depthCompareOp = compare.value_or(vk::CompareOp::eAlways)};
}

// Returns the key under which Pipelines stores a pipeline. Every property that is not part of the
// key is the same for all pipelines.
std::string key_of(const DrawState& state, const Layout& layout, const Specialization& constants) {
  std::vector<std::string_view> codes;
  std::string text;
  for (const DrawStage& each : state.stages) {
    codes.push_back(each.code);
    text += vk::to_string(each.stage) + " ";
  }
  text += fmt::format("{}; {}; {} {} {} {} {}x{}", code_hash(codes, constants), layout.definition,
                      vk::to_string(state.topology), state.patch_points, state.colour_targets,
                      state.depth ? vk::to_string(*state.depth) : "no depth", state.extent.width,
                      state.extent.height);
  for (const vk::VertexInputBindingDescription& each : state.vertex_bindings) {
    text +=
        fmt::format("; binding {} {} {}", each.binding, each.stride, vk::to_string(each.inputRate));
  }
  for (const vk::VertexInputAttributeDescription& each : state.vertex_attributes) {
    text += fmt::format("; attribute {} {} {} {}", each.location, each.binding,
                        vk::to_string(each.format), each.offset);
  }
  for (const vk::Format format : state.formats) text += "; " + vk::to_string(format);
  return text;
}

vk::raii::Pipeline make_pipeline(const Gpu& gpu, const Layout& layout,
                                 const vk::raii::RenderPass& pass, const DrawState& state,
                                 const Specialization& constants, vk::PipelineCreateFlags flags) {
  const Stages stages(gpu, state.stages, constants);
  const vk::PipelineVertexInputStateCreateInfo vertices{
      .vertexBindingDescriptionCount = static_cast<std::uint32_t>(state.vertex_bindings.size()),
      .pVertexBindingDescriptions = state.vertex_bindings.data(),
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(state.vertex_attributes.size()),
      .pVertexAttributeDescriptions = state.vertex_attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = state.topology};
  const vk::PipelineTessellationStateCreateInfo patches{.patchControlPoints = state.patch_points};
  const bool tessellates = state.topology == vk::PrimitiveTopology::ePatchList;
  const vk::Viewport viewport{.width = static_cast<float>(state.extent.width),
                              .height = static_cast<float>(state.extent.height),
                              .maxDepth = 1};
  const vk::PipelineViewportStateCreateInfo viewports{
      .viewportCount = 1, .pViewports = &viewport, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo fill{.lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples =
                                                              vk::SampleCountFlagBits::e1};
  const vk::PipelineDepthStencilStateCreateInfo depth = depth_state(state.depth);
  const auto targets = overwriting(state.colour_targets);
  const vk::PipelineColorBlendStateCreateInfo blend{
      .attachmentCount = static_cast<std::uint32_t>(targets.size()),
      .pAttachments = targets.data()};
  const auto begin = std::chrono::steady_clock::now();
  const vk::DynamicState scissor = vk::DynamicState::eScissor;
  const vk::PipelineDynamicStateCreateInfo dynamic{.dynamicStateCount = 1,
                                                   .pDynamicStates = &scissor};
  vk::raii::Pipeline pipeline(gpu.device, nullptr,
                              vk::GraphicsPipelineCreateInfo{
                                  .flags = flags,
                                  .stageCount = static_cast<std::uint32_t>(stages.infos().size()),
                                  .pStages = stages.infos().data(),
                                  .pVertexInputState = &vertices,
                                  .pInputAssemblyState = &assembly,
                                  .pTessellationState = tessellates ? &patches : nullptr,
                                  .pViewportState = &viewports,
                                  .pRasterizationState = &fill,
                                  .pMultisampleState = &one_sample,
                                  .pDepthStencilState = state.depth ? &depth : nullptr,
                                  .pColorBlendState = &blend,
                                  .pDynamicState = &dynamic,
                                  .layout = *layout.pipeline,
                                  .renderPass = *pass});
  for (const DrawStage& each : state.stages) {
    dump_shader(each.stage, each.code, constants, begin);
  }
  return pipeline;
}

}  // namespace

vk::Pipeline draw_pipeline(const Gpu& gpu, const Layout& layout, const vk::raii::RenderPass& pass,
                           const DrawState& state, const Specialization& constants) {
  StageNames names;
  for (const DrawStage& each : state.stages) {
    names.emplace_back(each.stage, shader_name(each.code));
  }
  return gpu.pipelines->get(key_of(state, layout, constants), names,
                            [&](vk::PipelineCreateFlags flags) {
                              return make_pipeline(gpu, layout, pass, state, constants, flags);
                            });
}

}  // namespace triptych::vulkan_backend
