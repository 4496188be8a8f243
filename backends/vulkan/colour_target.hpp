#pragma once
// Draws into a single colour image.

#include "backends/vulkan/memory.hpp"

namespace triptych::vulkan_backend {

// Returns the pipeline statistics that are meaningful for a draw into a single colour image.
[[nodiscard]] vk::QueryPipelineStatisticFlags draw_statistics();

// `begins` defines whether the pass begins with zeros (eClear) or with undefined content
// (eDontCare). At the end of the pass, the target is ready to be copied from.
[[nodiscard]] vk::raii::RenderPass colour_pass(const Gpu& gpu, vk::Format format,
                                               vk::AttachmentLoadOp begins);

[[nodiscard]] vk::raii::Framebuffer colour_framebuffer(const Gpu& gpu,
                                                       const vk::raii::RenderPass& pass,
                                                       const Image& target);

// Fills the framebuffer's only target, whose format is `format`, with NaN. Otherwise, newly
// allocated memory could contain a correct image from an earlier run.
void mark_unwritten(const Gpu& gpu, vk::Format format, const vk::raii::Framebuffer& framebuffer,
                    vk::Extent3D extent);

}  // namespace triptych::vulkan_backend
