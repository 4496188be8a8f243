#include "backends/vulkan/compute_frames.hpp"

#include <chrono>
#include <span>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/standalone.hpp"
#include "technique/volume/extra_work.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::string_view shader = "raycast.comp";

// Returns the number of work groups along one side of the image. Each work group of raycast.comp
// draws a tile of 8×8 pixels.
std::uint32_t tiles(int pixels) {
  return (static_cast<std::uint32_t>(pixels) + 7) / 8;
}

vk::DeviceSize output_bytes(const measure::VolumeWork& work) {
  return 4 * sizeof(float) *
         static_cast<vk::DeviceSize>(technique::drawn_pixels(work.scene.width, work.scene.height,
                                                             work.options.extra_work_stride));
}

}  // namespace

ComputeFrames::ComputeFrames(const Gpu& gpu, const Instance& instance,
                             const measure::VolumeWork& work, const Constants& constants)
    : gpu_(gpu),
      instance_(instance),
      constants_(constants),
      width_(work.scene.width),
      height_(work.scene.height),
      drawn_columns_(technique::drawn_columns(width_, work.options.extra_work_stride)),
      output_(gpu, output_bytes(work),
              vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc |
                  vk::BufferUsageFlagBits::eTransferDst,
              Place::device),
      resources_(gpu, work, &output_),
      timed_code_(raycast_spirv(shader, work, Pass::timed, resources_.parts() > 0)),
      counting_code_(raycast_spirv(shader, work, Pass::counting, resources_.parts() > 0)),
      tracing_code_(raycast_spirv(shader, work, Pass::tracing, resources_.parts() > 0)),
      pipeline_(compute_pipeline(gpu, resources_.layout(), timed_code_, constants)),
      frames_(gpu, vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations,
              [this](const vk::raii::CommandBuffer& commands) { record_timed(commands); }) {
  mark_unwritten(gpu, output_);
  if (resources_.parts() == 0) {
    dump_standalone(work, timed_code_, constants, tiles(drawn_columns_), tiles(height_));
  }
  instance_.check_validation();
}

void ComputeFrames::record_timed(const vk::raii::CommandBuffer& commands) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_);
  dispatch(commands, Pass::timed, drawn_columns_);
}

void ComputeFrames::dispatch(const vk::raii::CommandBuffer& commands, Pass pass,
                             int columns) const {
  const Label label(gpu_, commands, "raycast: one work group per 8x8 pixels");
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *resources_.layout().pipeline, 0,
                              resources_.set(pass), {});
  commands.dispatch(tiles(columns), tiles(height_), 1);
}

void ComputeFrames::prepare_counters() {
  resources_.bind_counters();
  record_counters(counting_code_);
}

void ComputeFrames::record_counters(std::string_view code) {
  counting_pipeline_ = compute_pipeline(gpu_, resources_.layout(), code, constants_);
  frames_.record_counters([this](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, counting_pipeline_);
    dispatch(commands, Pass::counting, width_);
  });
}

technique::RayTrace ComputeFrames::trace(int x, int y) {
  return translated([&] {
    if (tracing_code_.empty()) throw core::NotSupported(measure::pixel_history_unsupported);
    resources_.bind_trace(x, y, width_);
    record_counters(tracing_code_);
    static_cast<void>(resources_.parts() > 0 ? submit_parts(measure::Purpose::counters)
                                             : frames_.submit(measure::Purpose::counters));
    technique::RayTrace trace = resources_.read_trace();
    instance_.check_validation();
    return trace;
  });
}

void ComputeFrames::poison() {
  translated([&] {
    mark_unwritten(gpu_, output_);
    resources_.poison_counters();
  });
}

measure::Frame ComputeFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !frames_.can_count()) prepare_counters();
    measure::Frame frame = resources_.parts() > 0 ? submit_parts(purpose) : frames_.submit(purpose);
    if (counting) frame.counts = resources_.read_counters();
    instance_.check_validation();
    return frame;
  });
}

// Uploads and draws one part after another. Timestamps do not cover the uploads, so no device time
// is reported.
measure::Frame ComputeFrames::submit_parts(measure::Purpose purpose) {
  measure::Frame frame;
  const auto begin = std::chrono::steady_clock::now();
  for (int part = 0; part < resources_.parts(); ++part) {
    resources_.move_part(part);
    for (const auto& [name, count] : frames_.submit(purpose).counts) frame.counts[name] += count;
  }
  const auto end = std::chrono::steady_clock::now();
  frame.wall_ns = std::chrono::duration<double, std::nano>(end - begin).count();
  return frame;
}

core::Image ComputeFrames::image() {
  return translated([&] {
    core::Image image(width_, height_);
    download(gpu_, output_, std::as_writable_bytes(std::span(image.rgba)));
    instance_.check_validation();
    return image;
  });
}

std::string ComputeFrames::kernel_hash() const {
  return code_hash(timed_code_, constants_);
}

}  // namespace triptych::vulkan_backend
