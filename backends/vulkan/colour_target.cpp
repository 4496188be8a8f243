#include "backends/vulkan/colour_target.hpp"

#include <array>
#include <bit>

#include "measure/contract/not_drawn.hpp"

namespace triptych::vulkan_backend {

vk::QueryPipelineStatisticFlags draw_statistics() {
  using enum vk::QueryPipelineStatisticFlagBits;
  return eInputAssemblyVertices | eInputAssemblyPrimitives | eVertexShaderInvocations |
         eClippingInvocations | eClippingPrimitives | eFragmentShaderInvocations;
}

vk::raii::RenderPass colour_pass(const Gpu& gpu, vk::Format format, vk::AttachmentLoadOp begins) {
  const vk::AttachmentDescription target{.format = format,
                                         .loadOp = begins,
                                         .storeOp = vk::AttachmentStoreOp::eStore,
                                         .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
                                         .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
                                         .initialLayout = vk::ImageLayout::eUndefined,
                                         .finalLayout = vk::ImageLayout::eTransferSrcOptimal};
  const vk::AttachmentReference colour{.attachment = 0,
                                       .layout = vk::ImageLayout::eColorAttachmentOptimal};
  const vk::SubpassDescription subpass{.pipelineBindPoint = vk::PipelineBindPoint::eGraphics,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colour};
  return {gpu.device, vk::RenderPassCreateInfo{.attachmentCount = 1,
                                               .pAttachments = &target,
                                               .subpassCount = 1,
                                               .pSubpasses = &subpass}};
}

vk::raii::Framebuffer colour_framebuffer(const Gpu& gpu, const vk::raii::RenderPass& pass,
                                         const Image& target) {
  if (!gpu.executes) return nullptr;
  const vk::ImageView view = target.view();
  return {gpu.device, vk::FramebufferCreateInfo{.renderPass = *pass,
                                                .attachmentCount = 1,
                                                .pAttachments = &view,
                                                .width = target.extent().width,
                                                .height = target.extent().height,
                                                .layers = 1}};
}

void mark_unwritten(const Gpu& gpu, vk::Format format, const vk::raii::Framebuffer& framebuffer,
                    vk::Extent3D extent) {
  constexpr auto none = std::bit_cast<float>(measure::poison_word);
  const vk::ClearValue clear(vk::ClearColorValue(std::array{none, none, none, none}));
  const vk::raii::RenderPass pass = colour_pass(gpu, format, vk::AttachmentLoadOp::eClear);
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.beginRenderPass({.renderPass = *pass,
                              .framebuffer = *framebuffer,
                              .renderArea = {.extent = {extent.width, extent.height}},
                              .clearValueCount = 1,
                              .pClearValues = &clear},
                             vk::SubpassContents::eInline);
    commands.endRenderPass();
  });
}

}  // namespace triptych::vulkan_backend
