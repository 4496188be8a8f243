// Layers of triangles added up in a target of bytes.
#include <array>
#include <span>
#include <vector>

#include "backends/vulkan/colour_target.hpp"
#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/techniques.hpp"
#include "technique/anchors/anchor_work.hpp"
#include "technique/anchors/shape.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::string_view vertex_shader = "anchor_raster.vert.spv";
constexpr std::string_view fragment_shader = "anchor_raster.frag.spv";
constexpr vk::Format target_format = vk::Format::eR8G8B8A8Unorm;
constexpr std::uint32_t edge = technique::anchor_shape::raster_edge;
constexpr vk::Rect2D everything{.extent = {edge, edge}};

class RasterFrames final : public measure::Prepared {
 public:
  RasterFrames(const Gpu& gpu, const Instance& instance, const measure::AnchorWork& work);

  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override { return {}; }
  [[nodiscard]] std::string kernel_hash() const override {
    return code_hash(std::array{spirv(vertex_shader), spirv(fragment_shader)},
                     Specialization(Constants{}));
  }

 private:
  void draw(const vk::raii::CommandBuffer& commands) const;
  [[nodiscard]] std::uint32_t checksum() const;

  const Gpu& gpu_;
  const Instance& instance_;
  std::uint32_t vertices_;
  Image target_;
  Layout layout_;
  vk::raii::RenderPass render_pass_;
  vk::raii::Framebuffer framebuffer_;
  vk::Pipeline pipeline_;
  Frames frames_;
};

RasterFrames::RasterFrames(const Gpu& gpu, const Instance& instance,
                           const measure::AnchorWork& work)
    : gpu_(gpu),
      instance_(instance),
      vertices_(technique::anchor_frame("anchor_raster", work.size).vertices),
      target_(gpu, vk::ImageType::e2D, target_format, {edge, edge, 1},
              vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc),
      layout_(make_layout(gpu, {})),
      render_pass_(colour_pass(gpu, target_format, vk::AttachmentLoadOp::eClear)),
      framebuffer_(colour_framebuffer(gpu, render_pass_, target_)),
      pipeline_(
          draw_pipeline(gpu, layout_, render_pass_,
                        {.stages = {{vk::ShaderStageFlagBits::eVertex, spirv(vertex_shader)},
                                    {vk::ShaderStageFlagBits::eFragment, spirv(fragment_shader)}},
                         .added_up = true,
                         .extent = target_.extent(),
                         .formats = {target_format}},
                        Specialization(Constants{}))),
      frames_(gpu, draw_statistics(),
              [this](const vk::raii::CommandBuffer& commands) { draw(commands); }) {
  frames_.record_counters([this](const vk::raii::CommandBuffer& commands) { draw(commands); });
  instance_.check_validation();
}

void RasterFrames::draw(const vk::raii::CommandBuffer& commands) const {
  const vk::ClearValue zeros{};
  commands.beginRenderPass({.renderPass = *render_pass_,
                            .framebuffer = *framebuffer_,
                            .renderArea = everything,
                            .clearValueCount = 1,
                            .pClearValues = &zeros},
                           vk::SubpassContents::eInline);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline_);
  commands.setScissor(0, everything);
  commands.draw(vertices_, 1, 0, 0);
  commands.endRenderPass();
}

std::uint32_t RasterFrames::checksum() const {
  std::vector<std::byte> pixels(std::size_t{4} * edge * edge);
  download(gpu_, target_, pixels);
  std::uint32_t sum = 0;
  for (std::size_t red = 0; red < pixels.size(); red += 4) {
    sum += std::to_integer<std::uint32_t>(pixels[red]);
  }
  return sum;
}

measure::Frame RasterFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    measure::Frame frame = frames_.submit(purpose);
    if (purpose == measure::Purpose::counters) {
      frame.counts.emplace(technique::anchor_counter, checksum());
    }
    instance_.check_validation();
    return frame;
  });
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_anchor_raster(const Gpu& gpu, const Instance& instance,
                                                         const measure::AnchorWork& work) {
  return std::make_unique<RasterFrames>(gpu, instance, work);
}

}  // namespace triptych::vulkan_backend
