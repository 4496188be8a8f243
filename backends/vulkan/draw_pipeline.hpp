#pragma once
// Graphics pipelines as the techniques here need them: one viewport, a scissor set at draw time, no
// face culling, one sample.

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
  std::vector<vk::VertexInputBindingDescription> vertex_bindings;  // empty: no vertex buffers
  std::vector<vk::VertexInputAttributeDescription> vertex_attributes;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  std::uint32_t patch_points = 1;  // of ePatchList
  std::uint32_t colour_targets = 1;
  std::optional<vk::CompareOp> depth;  // tested and written where given
  vk::Extent3D extent;
  std::vector<vk::Format> formats;  // of the render pass's attachments, in its order
};

// All stages get the same specialization constants. The gpu's own (Pipelines): made where there is
// none of the kind yet.
[[nodiscard]] vk::Pipeline draw_pipeline(const Gpu& gpu, const Layout& layout,
                                         const vk::raii::RenderPass& pass, const DrawState& state,
                                         const Specialization& constants);

}  // namespace triptych::vulkan_backend
