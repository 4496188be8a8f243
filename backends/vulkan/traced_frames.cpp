#include "backends/vulkan/traced_frames.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/errors.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::string_view traced_vertex = "traced_show.vert.spv";
constexpr std::string_view traced_fragment = "traced_show.frag.spv";
constexpr std::uint32_t most_storage_buffers = 16;
constexpr std::uint32_t most_texel_buffers = 8;

std::uint64_t traced_words(const scene::ParticleScene& scene) {
  return 2 * static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
}

}  // namespace

Buffer device_words(const Gpu& gpu, std::uint64_t count) {
  using enum vk::BufferUsageFlagBits;
  constexpr std::uint64_t fewest = 4;
  return {gpu, sizeof(std::uint32_t) * std::max(count, fewest),
          eStorageBuffer | eUniformTexelBuffer | eTransferSrc | eTransferDst, Place::device};
}

TracedFrames::TracedFrames(const Gpu& gpu, const Instance& instance,
                           const measure::ParticleWork& work,
                           const technique::Arrangement& arrangement, MakeTracer make_tracer)
    : gpu_(gpu),
      instance_(instance),
      options_(work.options),
      constants_(particle_constants(gpu, work)),
      data_(gpu, work, arrangement),
      target_(gpu, work.scene,
              options_.fault == technique::ParticleFault::reversed_depth ? 1.0F : 0.0F),
      pixels_(device_words(gpu, traced_words(work.scene))),
      tracer_(make_tracer(gpu, work, arrangement, data_)),
      layout_(make_layout(gpu, bindings(), tracer_->push_bytes(), tracer_->stages())),
      pool_(make_pool(gpu, 1, most_storage_buffers, most_texel_buffers,
                      gpu.extensions.acceleration_structure ? 1 : 0)),
      set_(allocate_sets(gpu, pool_, layout_, 1).front()),
      frames_((prepare(), gpu), tracer_->statistics(),
              [this](const vk::raii::CommandBuffer& commands) { record(commands, false); }) {
  instance_.check_validation();
}

std::vector<vk::DescriptorSetLayoutBinding> TracedFrames::bindings() const {
  auto all = particle_bindings();
  all.push_back(storage_binding(traced_pixels_binding, vk::ShaderStageFlagBits::eCompute));
  for (std::uint32_t at = traced_pixel_texels_binding; at <= traced_id_texels_binding; ++at) {
    all.push_back({.binding = at,
                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                   .descriptorCount = 1,
                   .stageFlags = vk::ShaderStageFlagBits::eFragment});
  }
  for (vk::DescriptorSetLayoutBinding& each : all) each.stageFlags |= tracer_->stages();
  std::ranges::copy(tracer_->bindings(), std::back_inserter(all));
  return all;
}

void TracedFrames::prepare() {
  data_.bind(set_, Fetch::by_index);
  bind_buffer(gpu_, set_, traced_pixels_binding, vk::DescriptorType::eStorageBuffer, pixels_);
  const auto add_texel_view = [&](std::uint32_t binding, const Buffer& buffer, vk::Format format) {
    texels_.push_back({binding, texel_view(gpu_, buffer, format)});
    bind_texels(gpu_, set_, binding, texels_.back().view);
  };
  add_texel_view(traced_pixel_texels_binding, pixels_, vk::Format::eR32Uint);
  add_texel_view(traced_sphere_texels_binding, data_.spheres(), vk::Format::eR32G32B32A32Sfloat);
  add_texel_view(traced_colour_texels_binding, data_.colours(), vk::Format::eR32Uint);
  add_texel_view(traced_id_texels_binding, data_.ids(), vk::Format::eR32Uint);
  tracer_->bind(set_);
  DrawState state{.stages = {{vk::ShaderStageFlagBits::eVertex, spirv(traced_vertex)},
                             {vk::ShaderStageFlagBits::eFragment, spirv(traced_fragment)}},
                  .colour_targets = ParticleTarget::colour_targets,
                  .depth = depth_compare(options_.fault),
                  .extent = target_.extent(),
                  .formats = ParticleTarget::formats()};
  show_ = draw_pipeline(gpu_, layout_, target_.pass(), state, constants_);
  run_once(gpu_, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(pixels_.get(), 0, VK_WHOLE_SIZE, 0);
  });
  tracer_->prepare(layout_, set_);
}

void TracedFrames::record(const vk::raii::CommandBuffer& commands, bool counting) const {
  for (const auto point : {vk::PipelineBindPoint::eCompute, vk::PipelineBindPoint::eGraphics}) {
    commands.bindDescriptorSets(point, *layout_.pipeline, 0, set_, {});
  }
  if (tracer_->stages() & vk::ShaderStageFlagBits::eRaygenKHR) {
    commands.bindDescriptorSets(vk::PipelineBindPoint::eRayTracingKHR, *layout_.pipeline, 0, set_,
                                {});
  }
  if (counting) data_.clear_counters(commands);
  if (data_.particles() > 0) {
    const Label label(gpu_, commands, "trace rays");
    tracer_->record(commands, layout_, counting);
    barrier(commands);
  }
  const Label label(gpu_, commands, "shade ray hits");
  target_.begin(commands, false);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, show_);
  if (data_.particles() > 0) commands.draw(3, 1, 0, 0);
  commands.endRenderPass();
}

void TracedFrames::poison() {
  translated([&] {
    target_.poison(gpu_);
    data_.poison_counters();
    mark_unwritten(gpu_, pixels_);
  });
}

measure::Frame TracedFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !frames_.can_count()) {
      tracer_->prepare_counting(layout_);
      frames_.record_counters(
          [this](const vk::raii::CommandBuffer& commands) { record(commands, true); });
    }
    measure::Frame frame = frames_.submit(purpose);
    if (counting) {
      frame.counts = data_.counts(technique::Method::rays, options_.culling, target_.read(gpu_));
      if (!tracer_->counts_nodes()) {
        // The driver decides which candidates its acceleration structure reports, so these counters
        // would differ between drivers.
        for (const char* each : {"nodes_visited", "boxes_tested", "intersections_tested"}) {
          frame.counts.erase(each);
        }
      }
    }
    instance_.check_validation();
    return frame;
  });
}

core::Image TracedFrames::image() {
  return translated([&] {
    core::Image image = target_.read(gpu_);
    instance_.check_validation();
    return image;
  });
}

std::string TracedFrames::kernel_hash() const {
  std::vector<std::string_view> codes = tracer_->codes();
  codes.insert(codes.end(), {spirv(traced_vertex), spirv(traced_fragment)});
  return code_hash(codes, constants_);
}

std::unique_ptr<measure::Prepared> prepare_traced(const Gpu& gpu, const Instance& instance,
                                                  const measure::ParticleWork& work,
                                                  TracedFrames::MakeTracer make_tracer) {
  return std::make_unique<TracedFrames>(gpu, instance, work, technique::arrange(work.scene),
                                        make_tracer);
}

}  // namespace triptych::vulkan_backend
