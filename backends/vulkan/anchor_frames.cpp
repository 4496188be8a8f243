#include "backends/vulkan/anchor_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/filter_probe.hpp"
#include "backends/vulkan/support.hpp"
#include "technique/anchors/shape.hpp"

namespace triptych::vulkan_backend {
namespace {

namespace shape = technique::anchor_shape;
constexpr vk::Format volume_format = vk::Format::eR32Sfloat;

// Only what the code uses: lavapipe looks into every binding of a set, filled or not.
Layout make_anchor_layout(const Gpu& gpu, const technique::AnchorFrame& shape) {
  using enum vk::DescriptorType;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  const auto add = [&](std::uint32_t number, vk::DescriptorType type) {
    bindings.push_back({.binding = number,
                        .descriptorType = type,
                        .descriptorCount = 1,
                        .stageFlags = vk::ShaderStageFlagBits::eCompute});
  };
  add(technique::anchor_parameters_binding, eUniformBuffer);
  add(technique::anchor_results_binding, eStorageBuffer);
  if (shape.source_words > 0) add(technique::anchor_source_binding, eStorageBuffer);
  if (shape.fetches) add(technique::anchor_volume_binding, eCombinedImageSampler);
  return make_layout(gpu, bindings);
}

std::optional<Buffer> make_source(const Gpu& gpu, std::uint64_t words) {
  if (words == 0) return std::nullopt;
  const std::vector<std::uint32_t> source = technique::anchor_source(words);
  return make_buffer(gpu, std::as_bytes(std::span(source)),
                     vk::BufferUsageFlagBits::eStorageBuffer);
}

std::optional<Image> make_volume(const Gpu& gpu, bool fetches) {
  if (!fetches) return std::nullopt;
  constexpr std::uint32_t edge = shape::fetch_edge;
  std::optional<Image> volume;
  volume.emplace(gpu, vk::ImageType::e3D, volume_format, vk::Extent3D{edge, edge, edge},
                 vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  const std::vector<float> voxels = technique::anchor_volume();
  upload(gpu, *volume, std::as_bytes(std::span(voxels)));
  return volume;
}

}  // namespace

std::optional<std::string> anchor_reason(const Gpu& gpu, const measure::AnchorWork& work,
                                         const std::string& technique) {
  if (auto reason = technique::anchor_size_reason(technique, work.size)) return reason;
  const technique::AnchorFrame frame = technique::anchor_frame(technique, work.size);
  if (frame.vertices > 0) {
    constexpr std::uint64_t pixel_bytes = 4;
    return picture_reason(gpu, shape::raster_edge, shape::raster_edge, Needs::drawing, pixel_bytes);
  }
  if (frame.fetches && !can_filter(gpu, scene::VoxelFormat::f32)) {
    return fmt::format("cannot filter images of format {} linearly", vk::to_string(volume_format));
  }
  const std::uint64_t bytes = sizeof(std::uint32_t) * frame.result_words;
  const std::uint32_t most = gpu.properties.limits.maxStorageBufferRange;
  if (bytes > most) {
    return fmt::format("needs {} bytes in one buffer; maxStorageBufferRange = {}", bytes, most);
  }
  return memory_reason(gpu, bytes + sizeof(std::uint32_t) * frame.source_words);
}

AnchorFrames::AnchorFrames(const Gpu& gpu, const Instance& instance, std::string_view technique,
                           const measure::AnchorWork& work)
    : gpu_(gpu),
      instance_(instance),
      code_(std::string(technique) + ".comp.spv"),
      shape_(technique::anchor_frame(technique, work.size)),
      parameters_(make_buffer(gpu, std::as_bytes(std::span(&shape_.parameters, 1)),
                              vk::BufferUsageFlagBits::eUniformBuffer)),
      results_(gpu, sizeof(std::uint32_t) * shape_.result_words,
               vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc |
                   vk::BufferUsageFlagBits::eTransferDst,
               Place::device),
      source_(make_source(gpu, shape_.source_words)),
      volume_(make_volume(gpu, shape_.fetches)),
      sampler_(make_sampler(gpu, vk::Filter::eLinear)),
      layout_(make_anchor_layout(gpu, shape_)),
      pool_(make_pool(gpu, 1)),
      set_(make_set()),
      pipeline_(compute_pipeline(gpu, layout_, spirv(code_), Constants{})),
      frames_(gpu, vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations,
              [this](const vk::raii::CommandBuffer& commands) { record_launches(commands); }) {
  frames_.record_counters([this](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(results_.get(), 0, VK_WHOLE_SIZE, 0);
    barrier(commands);
    record_launches(commands);
  });
  instance_.check_validation();
}

vk::DescriptorSet AnchorFrames::make_set() const {
  using enum vk::DescriptorType;
  const vk::DescriptorSet set = allocate_sets(gpu_, pool_, layout_, 1).front();
  bind_buffer(gpu_, set, technique::anchor_parameters_binding, eUniformBuffer, parameters_);
  bind_buffer(gpu_, set, technique::anchor_results_binding, eStorageBuffer, results_);
  if (source_) {
    bind_buffer(gpu_, set, technique::anchor_source_binding, eStorageBuffer, *source_);
  }
  if (volume_) bind_texture(gpu_, set, technique::anchor_volume_binding, *volume_, sampler_);
  return set;
}

void AnchorFrames::record_launches(const vk::raii::CommandBuffer& commands) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline, 0, set_, {});
  for (std::uint32_t i = 0; i < shape_.launches; ++i) commands.dispatch(shape_.groups, 1, 1);
}

measure::Frame AnchorFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    measure::Frame frame = frames_.submit(purpose);
    if (purpose == measure::Purpose::counters) {
      std::vector<std::uint32_t> words(shape_.result_words);
      download(gpu_, results_, std::as_writable_bytes(std::span(words)));
      frame.counts.emplace(technique::anchor_counter, technique::anchor_checksum(words));
    }
    instance_.check_validation();
    return frame;
  });
}

std::string AnchorFrames::kernel_hash() const {
  return code_hash(spirv(code_), Constants{});
}

}  // namespace triptych::vulkan_backend
