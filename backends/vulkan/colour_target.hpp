#pragma once
// Drawing into a single image of colours.

#include "backends/vulkan/memory.hpp"

namespace triptych::vulkan_backend {

// What such a draw can count.
[[nodiscard]] vk::QueryPipelineStatisticFlags draw_statistics();

// `begins`: with zeros (eClear) or with anything (eDontCare). Leaves the target ready to be copied
// from.
[[nodiscard]] vk::raii::RenderPass colour_pass(const Gpu& gpu, vk::Format format,
                                               vk::AttachmentLoadOp begins);

[[nodiscard]] vk::raii::Framebuffer colour_framebuffer(const Gpu& gpu,
                                                       const vk::raii::RenderPass& pass,
                                                       const Image& target);

// Fills the framebuffer's one target, which is of such a format, with NaN. Fresh memory may hold
// what was right before.
void mark_unwritten(const Gpu& gpu, vk::Format format, const vk::raii::Framebuffer& framebuffer,
                    vk::Extent3D extent);

}  // namespace triptych::vulkan_backend
