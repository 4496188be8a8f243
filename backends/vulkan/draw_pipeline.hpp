#pragma once
// The graphics pipelines of the techniques: one viewport, a scissor that is set at draw time, no
// face culling, one sample per pixel.

#include <optional>
#include <string_view>
#include <vector>

#include "backends/vulkan/pipeline.hpp"

namespace triptych::vulkan_backend {

struct DrawStage {
  vk::ShaderStageFlagBits stage;
  std::string_view code;  // SPIR-V
};

struct DrawState {
  std::vector<DrawStage> stages;
  std::vector<vk::VertexInputBindingDescription> vertex_bindings;  // empty without vertex buffers
  std::vector<vk::VertexInputAttributeDescription> vertex_attributes;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  std::uint32_t patch_points = 1;  // control points of a patch, for ePatchList
  std::uint32_t colour_targets = 1;
  std::optional<vk::CompareOp> depth;  // if this is set, depth is tested and written
  vk::Extent3D extent;
  std::vector<vk::Format> formats;  // formats of the render pass attachments, in the same order
};

// Returns a pipeline whose stages all have the same specialization constants. The Gpu owns the
// pipeline (Pipelines) and creates it unless the same pipeline already exists.
[[nodiscard]] vk::Pipeline draw_pipeline(const Gpu& gpu, const Layout& layout,
                                         const vk::raii::RenderPass& pass, const DrawState& state,
                                         const Specialization& constants);

}  // namespace triptych::vulkan_backend
