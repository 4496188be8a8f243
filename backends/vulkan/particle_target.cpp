#include "backends/vulkan/particle_target.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace triptych::vulkan_backend {
namespace {

constexpr vk::Format attachment_format = vk::Format::eR32G32B32A32Sfloat;
constexpr vk::Format id_format = vk::Format::eR32Uint;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

Image make_target(const Gpu& gpu, const scene::ParticleScene& scene, vk::Format format) {
  using enum vk::ImageUsageFlagBits;
  const bool depth = format == depth_format;
  const vk::Extent3D extent{static_cast<std::uint32_t>(scene.width),
                            static_cast<std::uint32_t>(scene.height), 1};
  return {
      gpu,
      vk::ImageType::e2D,
      format,
      extent,
      depth ? eDepthStencilAttachment | eSampled | eTransferSrc : eColorAttachment | eTransferSrc,
      depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor};
}

vk::AttachmentDescription attachment(vk::Format format, bool continued) {
  using enum vk::ImageLayout;
  return {.format = format,
          .loadOp = continued ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
          .storeOp = vk::AttachmentStoreOp::eStore,
          .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
          .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
          .initialLayout = continued ? eTransferSrcOptimal : eUndefined,
          .finalLayout = eTransferSrcOptimal};
}

vk::raii::RenderPass make_pass(const Gpu& gpu, bool continued) {
  using enum vk::ImageLayout;
  const std::array<vk::AttachmentDescription, 3> attachments{
      attachment(attachment_format, continued), attachment(id_format, continued),
      attachment(depth_format, continued)};
  const std::array<vk::AttachmentReference, 2> colours{
      {{.attachment = 0, .layout = eColorAttachmentOptimal},
       {.attachment = 1, .layout = eColorAttachmentOptimal}}};
  const vk::AttachmentReference depth{.attachment = 2, .layout = eDepthStencilAttachmentOptimal};
  const vk::SubpassDescription subpass{
      .pipelineBindPoint = vk::PipelineBindPoint::eGraphics,
      .colorAttachmentCount = static_cast<std::uint32_t>(colours.size()),
      .pColorAttachments = colours.data(),
      .pDepthStencilAttachment = &depth};
  return {gpu.device, vk::RenderPassCreateInfo{
                          .attachmentCount = static_cast<std::uint32_t>(attachments.size()),
                          .pAttachments = attachments.data(),
                          .subpassCount = 1,
                          .pSubpasses = &subpass}};
}

vk::raii::Framebuffer make_framebuffer(const Gpu& gpu, const vk::raii::RenderPass& pass,
                                       std::span<const vk::ImageView> views, vk::Extent3D extent) {
  if (!gpu.executes) return nullptr;
  return {gpu.device,
          vk::FramebufferCreateInfo{.renderPass = *pass,
                                    .attachmentCount = static_cast<std::uint32_t>(views.size()),
                                    .pAttachments = views.data(),
                                    .width = extent.width,
                                    .height = extent.height,
                                    .layers = 1}};
}

}  // namespace

vk::CompareOp depth_compare(technique::ParticleFault fault) {
  using technique::ParticleFault;
  if (fault == ParticleFault::reversed_depth) return vk::CompareOp::eLess;
  if (fault == ParticleFault::unresolved_ties) return vk::CompareOp::eGreaterOrEqual;
  return vk::CompareOp::eGreater;
}

void resolve_depth(core::Image& image, double near) {
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    const bool none = image.ids[i] == core::Image::no_particle;
    image.depth[i] = none ? std::numeric_limits<float>::infinity()
                          : static_cast<float>(near / static_cast<double>(image.depth[i]));
  }
}

ParticleTarget::ParticleTarget(const Gpu& gpu, const scene::ParticleScene& scene,
                               float cleared_depth)
    : near_(scene.camera.near),
      clear_{vk::ClearColorValue(scene.background),
             vk::ClearColorValue(std::array<std::uint32_t, 4>{core::Image::no_particle, 0, 0, 0}),
             vk::ClearDepthStencilValue{.depth = cleared_depth}},
      colour_(make_target(gpu, scene, attachment_format)),
      ids_(make_target(gpu, scene, id_format)),
      depth_(make_target(gpu, scene, depth_format)),
      clearing_(make_pass(gpu, false)),
      continuing_(make_pass(gpu, true)),
      framebuffer_(make_framebuffer(gpu, clearing_,
                                    std::array{colour_.view(), ids_.view(), depth_.view()},
                                    colour_.extent())) {}

std::vector<vk::Format> ParticleTarget::formats() {
  return {attachment_format, id_format, depth_format};
}

std::optional<std::string> ParticleTarget::format_reason(const Gpu& gpu) {
  using enum vk::FormatFeatureFlagBits;
  constexpr vk::FormatFeatureFlags needed = eDepthStencilAttachment | eSampledImage;
  const auto offered = gpu.physical.getFormatProperties(depth_format).optimalTilingFeatures;
  if ((offered & needed) == needed) return std::nullopt;
  return "the device does not support sampled depth buffers of format " +
         vk::to_string(depth_format);
}

void ParticleTarget::begin(const vk::raii::CommandBuffer& commands, bool continued) const {
  const vk::Rect2D whole_area{.extent = {extent().width, extent().height}};
  commands.beginRenderPass({.renderPass = continued ? *continuing_ : *clearing_,
                            .framebuffer = *framebuffer_,
                            .renderArea = whole_area,
                            .clearValueCount = static_cast<std::uint32_t>(clear_.size()),
                            .pClearValues = clear_.data()},
                           vk::SubpassContents::eInline);
  commands.setScissor(0, whole_area);
}

// Fills the depth buffer with a value that cannot remain in any pixel, because every frame first
// clears the depth to a different value.
void ParticleTarget::poison(const Gpu& gpu) const {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const std::array<vk::ClearValue, 3> values{
      vk::ClearColorValue(std::array{none, none, none, none}),
      vk::ClearColorValue(std::array<std::uint32_t, 4>{core::Image::no_particle - 1, 0, 0, 0}),
      vk::ClearDepthStencilValue{.depth = 0.75F}};
  run_once(gpu, [&](const vk::raii::CommandBuffer& commands) {
    commands.beginRenderPass({.renderPass = *clearing_,
                              .framebuffer = *framebuffer_,
                              .renderArea = {.extent = {extent().width, extent().height}},
                              .clearValueCount = static_cast<std::uint32_t>(values.size()),
                              .pClearValues = values.data()},
                             vk::SubpassContents::eInline);
    commands.endRenderPass();
  });
}

core::Image ParticleTarget::read(const Gpu& gpu) const {
  core::Image image(static_cast<int>(extent().width), static_cast<int>(extent().height));
  image.depth.resize(image.pixel_count());
  image.ids.resize(image.pixel_count());
  download(gpu, colour_, std::as_writable_bytes(std::span(image.rgba)));
  download(gpu, ids_, std::as_writable_bytes(std::span(image.ids)));
  download(gpu, depth_, std::as_writable_bytes(std::span(image.depth)));
  resolve_depth(image, near_);
  return image;
}

}  // namespace triptych::vulkan_backend
