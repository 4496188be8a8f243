// Traces one ray per fragment of a triangle that covers a floating-point render target.
#include <algorithm>
#include <array>
#include <span>

#include "backends/vulkan/colour_target.hpp"
#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "measure/contract/pixel_history.hpp"
#include "technique/volume/extra_work.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::string_view vertex_shader = "raycast_fragment.vert.spv";
constexpr std::string_view fragment_shader = "raycast_fragment.frag";
constexpr vk::Format target_format = vk::Format::eR32G32B32A32Sfloat;

// Creates the pipeline for a full-screen triangle without vertex buffers.
vk::Pipeline make_pipeline(const Gpu& gpu, const Layout& layout, const vk::raii::RenderPass& pass,
                           vk::Extent3D extent, std::string_view fragment_code,
                           const Constants& constants) {
  return draw_pipeline(gpu, layout, pass,
                       {.stages = {{vk::ShaderStageFlagBits::eVertex, spirv(vertex_shader)},
                                   {vk::ShaderStageFlagBits::eFragment, fragment_code}},
                        .extent = extent,
                        .formats = {target_format}},
                       Specialization(constants));
}

class FragmentFrames final : public measure::Prepared, public measure::PixelTracer {
 public:
  FragmentFrames(const Gpu& gpu, const Instance& instance, const measure::VolumeWork& work);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override {
    return code_hash(timed_code_, constants_);
  }
  [[nodiscard]] technique::RayTrace trace(int x, int y) override;

 private:
  void draw(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline, Pass pass) const;
  void draw_again(const vk::raii::CommandBuffer& commands) const;
  void prepare_counters();
  void record_counters(std::string_view code);

  const Gpu& gpu_;
  const Instance& instance_;
  Constants constants_;
  std::string_view timed_code_;
  std::string_view counting_code_;
  std::string_view tracing_code_;  // empty if this work cannot be traced
  std::vector<technique::ExtraTile> extra_tiles_;
  Image target_;
  VolumeResources resources_;
  vk::raii::RenderPass render_pass_;
  vk::raii::Framebuffer framebuffer_;
  vk::Pipeline pipeline_;
  vk::Pipeline counting_pipeline_;  // null until work is to be counted
  Frames frames_;
};

FragmentFrames::FragmentFrames(const Gpu& gpu, const Instance& instance,
                               const measure::VolumeWork& work)
    : gpu_(gpu),
      instance_(instance),
      constants_(constants_of(work)),
      timed_code_(raycast_spirv(fragment_shader, work, Pass::timed)),
      counting_code_(raycast_spirv(fragment_shader, work, Pass::counting)),
      tracing_code_(raycast_spirv(fragment_shader, work, Pass::tracing)),
      extra_tiles_(technique::extra_tiles(work.scene.width, work.scene.height,
                                          work.options.extra_work_stride)),
      target_(gpu, vk::ImageType::e2D, target_format,
              {static_cast<std::uint32_t>(work.scene.width),
               static_cast<std::uint32_t>(work.scene.height), 1},
              vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc),
      resources_(gpu, work, nullptr),
      render_pass_(colour_pass(gpu, target_format, vk::AttachmentLoadOp::eDontCare)),
      framebuffer_(colour_framebuffer(gpu, render_pass_, target_)),
      pipeline_(make_pipeline(gpu, resources_.layout(), render_pass_, target_.extent(), timed_code_,
                              constants_)),
      frames_(gpu, draw_statistics(), [this](const vk::raii::CommandBuffer& commands) {
        draw(commands, pipeline_, Pass::timed);
      }) {
  mark_unwritten(gpu, target_format, framebuffer_, target_.extent());
  instance_.check_validation();
}

void FragmentFrames::draw(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline,
                          Pass pass) const {
  const Label label(gpu_, commands, "raycast_fragment: one triangle covering the image");
  const vk::Extent3D extent = target_.extent();
  const vk::Rect2D whole_area{.extent = {extent.width, extent.height}};
  commands.beginRenderPass(
      {.renderPass = *render_pass_, .framebuffer = *framebuffer_, .renderArea = whole_area},
      vk::SubpassContents::eInline);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *resources_.layout().pipeline, 0,
                              resources_.set(pass), {});
  commands.setScissor(0, whole_area);
  commands.draw(3, 1, 0, 0);
  if (pass == Pass::timed) draw_again(commands);
  commands.endRenderPass();
}

void FragmentFrames::draw_again(const vk::raii::CommandBuffer& commands) const {
  for (const technique::ExtraTile& tile : extra_tiles_) {
    commands.setScissor(0, vk::Rect2D{.offset = {tile.x, tile.y},
                                      .extent = {static_cast<std::uint32_t>(tile.width),
                                                 static_cast<std::uint32_t>(tile.height)}});
    commands.draw(3, 1, 0, 0);
  }
}

void FragmentFrames::prepare_counters() {
  resources_.bind_counters();
  record_counters(counting_code_);
}

void FragmentFrames::record_counters(std::string_view code) {
  counting_pipeline_ =
      make_pipeline(gpu_, resources_.layout(), render_pass_, target_.extent(), code, constants_);
  frames_.record_counters([this](const vk::raii::CommandBuffer& commands) {
    draw(commands, counting_pipeline_, Pass::counting);
  });
}

technique::RayTrace FragmentFrames::trace(int x, int y) {
  return translated([&] {
    if (tracing_code_.empty()) throw core::NotSupported(measure::pixel_history_unsupported);
    resources_.bind_trace(x, y, static_cast<int>(target_.extent().width));
    record_counters(tracing_code_);
    static_cast<void>(frames_.submit(measure::Purpose::counters));
    technique::RayTrace trace = resources_.read_trace();
    instance_.check_validation();
    return trace;
  });
}

void FragmentFrames::poison() {
  translated([&] {
    mark_unwritten(gpu_, target_format, framebuffer_, target_.extent());
    resources_.poison_counters();
  });
}

measure::Frame FragmentFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !frames_.can_count()) prepare_counters();
    measure::Frame frame = frames_.submit(purpose);
    if (counting) frame.counts = resources_.read_counters();
    instance_.check_validation();
    return frame;
  });
}

core::Image FragmentFrames::image() {
  return translated([&] {
    core::Image image(static_cast<int>(target_.extent().width),
                      static_cast<int>(target_.extent().height));
    download(gpu_, target_, std::as_writable_bytes(std::span(image.rgba)));
    instance_.check_validation();
    return image;
  });
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_raycast_fragment(const Gpu& gpu,
                                                            const Instance& instance,
                                                            const measure::VolumeWork& work) {
  return std::make_unique<FragmentFrames>(gpu, instance, work);
}

}  // namespace triptych::vulkan_backend
