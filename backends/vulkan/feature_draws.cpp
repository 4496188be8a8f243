// The feature probes that draw points. The number of a point determines its pixel.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "backends/vulkan/colour_target.hpp"
#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/feature_kernel.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

struct PointGrid {
  std::uint32_t width;
  std::uint32_t height;
};

// Draws a point on each of the first `count` pixels. `draw` records the draw commands. The vertex
// and instance numbers that these commands produce determine the pixel of each point.
template <class Draw>
measure::ProbedFeature probe_points(const Gpu& gpu, PointGrid grid, std::uint32_t count,
                                    std::string size, const Draw& draw) {
  if (!gpu.draws) throw core::NotSupported("the device has no graphics queue");
  const std::uint32_t most = gpu.properties.limits.maxImageDimension2D;
  if (std::max(grid.width, grid.height) > most) {
    throw core::NotSupported(fmt::format("needs an image of {} x {}, but maxImageDimension2D is {}",
                                         grid.width, grid.height, most));
  }
  constexpr vk::Format format = vk::Format::eR32Uint;
  const Image target(
      gpu, vk::ImageType::e2D, format, {grid.width, grid.height, 1},
      vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
  const vk::raii::RenderPass pass = colour_pass(gpu, format, vk::AttachmentLoadOp::eClear);
  const vk::raii::Framebuffer framebuffer = colour_framebuffer(gpu, pass, target);
  const Layout layout = make_layout(gpu, {}, sizeof grid, vk::ShaderStageFlagBits::eVertex);
  const vk::Pipeline pipeline = draw_pipeline(
      gpu, layout, pass,
      {.stages = {{vk::ShaderStageFlagBits::eVertex, spirv("features_points.vert.spv")},
                  {vk::ShaderStageFlagBits::eFragment, spirv("features_points.frag.spv")}},
       .topology = vk::PrimitiveTopology::ePointList,
       .extent = target.extent(),
       .formats = {format}},
      Specialization(NoConstants{}));
  const vk::ClearValue clear(vk::ClearColorValue(std::array{0U, 0U, 0U, 0U}));
  const vk::Rect2D whole_area{.extent = {grid.width, grid.height}};
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.beginRenderPass({.renderPass = *pass,
                              .framebuffer = *framebuffer,
                              .renderArea = whole_area,
                              .clearValueCount = 1,
                              .pClearValues = &clear},
                             vk::SubpassContents::eInline);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.setScissor(0, whole_area);
    commands.pushConstants<PointGrid>(*layout.pipeline, vk::ShaderStageFlagBits::eVertex, 0, grid);
    draw(commands);
    commands.endRenderPass();
  });
  std::vector<std::uint32_t> found(std::size_t{grid.width} * grid.height);
  download(gpu, target, std::as_writable_bytes(std::span(found)));
  return measure::judged_feature(
      measure::count_right(found, [&](std::size_t i) { return i < count ? i + 1 : 0; }),
      found.size(), std::move(size));
}

}  // namespace

measure::ProbedFeature probe_indirect_draws(const Gpu& gpu) {
  if (gpu.features.multiDrawIndirect == VK_FALSE ||
      gpu.features.drawIndirectFirstInstance == VK_FALSE) {
    throw core::NotSupported("needs multiDrawIndirect and drawIndirectFirstInstance");
  }
  const std::uint32_t count = std::min(gpu.properties.limits.maxDrawIndirectCount, 100'000U);
  std::vector<vk::DrawIndirectCommand> draws;
  for (std::uint32_t i = 0; i < count; ++i) {
    draws.push_back({.vertexCount = 1, .instanceCount = 1, .firstVertex = 0, .firstInstance = i});
  }
  const Buffer commands_buffer =
      make_buffer(gpu, std::as_bytes(std::span(draws)), vk::BufferUsageFlagBits::eIndirectBuffer);
  return probe_points(gpu, {512, 196}, count, fmt::format("{} draws", count),
                      [&](const vk::raii::CommandBuffer& commands) {
                        commands.drawIndirect(commands_buffer.get(), 0, count,
                                              sizeof(vk::DrawIndirectCommand));
                      });
}

measure::ProbedFeature probe_instances(const Gpu& gpu) {
  constexpr std::uint32_t count = 10'000'000;
  return probe_points(gpu, {4096, 2442}, count, fmt::format("{} instances", count),
                      [&](const vk::raii::CommandBuffer& commands) {
                        commands.draw(1, count - 1000, 0, 1000);  // the first instance is not 0
                        commands.draw(1, 1000, 0, 0);
                      });
}

// Draws with indices that are 1000 too large and a vertex offset of -1000.
measure::ProbedFeature probe_base_vertex(const Gpu& gpu) {
  constexpr std::uint32_t count = 100'000;
  constexpr std::int32_t base = -1000;
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(-base));
  const Buffer buffer =
      make_buffer(gpu, std::as_bytes(std::span(indices)), vk::BufferUsageFlagBits::eIndexBuffer);
  return probe_points(gpu, {512, 196}, count, fmt::format("base vertex {}", base),
                      [&](const vk::raii::CommandBuffer& commands) {
                        commands.bindIndexBuffer(buffer.get(), 0, vk::IndexType::eUint32);
                        commands.drawIndexed(count, 1, 0, base, 0);
                      });
}

}  // namespace triptych::vulkan_backend
