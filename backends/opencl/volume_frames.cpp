#include "backends/opencl/volume_frames.hpp"

#include <cstdint>
#include <span>

#include "backends/opencl/standalone.hpp"
#include "measure/contract/not_drawn.hpp"
#include "technique/volume/brick_map.hpp"
#include "technique/volume/bricks.hpp"
#include "technique/volume/extra_work.hpp"
#include "technique/volume/parts.hpp"
#include "technique/volume/preintegration.hpp"
#include "technique/volume/quadrature_table.hpp"
#include "technique/volume/raycast_buffers.hpp"
#include "technique/volume/raycast_parameters.hpp"

namespace triptych::opencl_backend {
namespace {

std::vector<std::string_view> source_files(const Constants& constants) {
  if (constants.cells) {
    return {
        "volume_preintegration.h", "parameters.cl", "volume.cl", "ray.cl", "shade.cl", "cells.cl"};
  }
  std::vector<std::string_view> files{
      "volume_preintegration.h", "parameters.cl", "volume.cl", "ray.cl", "shade.cl",
      "preintegrated.cl"};
  if (constants.trace) files.emplace_back("trace.cl");
  files.emplace_back("raycast.cl");
  return files;
}

// The size of a work group in pixels. It is large enough for the waves of a GPU, and makes no
// difference on a CPU.
constexpr std::size_t group_width = 16;
constexpr std::size_t group_height = 4;

}  // namespace

Constants constants_of(const Session& session, const measure::VolumeWork& work) {
  return {.sampler = work.options.sampler,
          .voxel = work.scene.grid->format,
          .shading = work.scene.shading.enabled,
          .preintegrated = technique::preintegration_form(work.scene),
          .cells = work.scene.quadrature == scene::Quadrature::cells,
          .leaps = work.options.skip == technique::Skip::distance,
          .adapt = work.options.adapt > 0,
          .precision = work.options.precision,
          .fault = work.options.fault,
          .batch = session.batch};
}

VolumeFrames::VolumeFrames(const Session& session, Programs& programs, VolumeCache& volumes,
                           const measure::VolumeWork& work, Constants constants)
    : session_(session),
      programs_(programs),
      constants_(constants),
      width_(work.scene.width),
      height_(work.scene.height),
      counts_(technique::raycast_counter_stride * static_cast<std::size_t>(width_) *
              static_cast<std::size_t>(height_)) {
  const technique::Cut cut =
      cut_of(session, constants.speed_of_light ? "speed_of_light" : "raycast", work);
  constants_.parts = constants.parts = !cut.parts.empty();
  const std::string source = program_source(source_files(constants));
  hash_ = Programs::hash(source, constants.options());
  const cl::Program timed = programs.get(source, constants.options());
  const Constants timed_constants = constants;
  constants.count = true;
  const cl::Program counting = programs.get(source, constants.options());
  const VolumeCache::Entry& volume =
      volumes.get(session, *work.scene.grid, constants.sampler,
                  technique::brick_layout(work.scene, work.options.skip, work.options.adapt),
                  technique::most_stored_cells(cut.parts));
  const std::vector<std::int32_t> map =
      technique::brick_map(volume.ranges, work.scene, work.options.skip, work.options.adapt);
  if (cut.parts.empty()) dump_standalone(session, work, source, timed_constants, map);
  checked([&] {
    volume_ = volume.volume;
    upload_surroundings(work, constants, map);
    const int stride = work.options.extra_work_stride;
    timed_.push_back(launch(timed, technique::drawn_columns(width_, stride)));
    counting_.push_back(launch(counting, width_));
    if (cut.parts.empty()) return;
    pauses_ =
        make_buffer(session, CL_MEM_READ_WRITE, technique::pauses_bytes(work.scene, work.options));
    for (Launch* each : {&timed_.front(), &counting_.front()}) each->kernel.setArg(7, pauses_);
    parts_.emplace(session, work, cut.parts, map, cl::Buffer(volume_(), true), parameters_);
  });
}

// Uploads everything except the voxels.
void VolumeFrames::upload_surroundings(const measure::VolumeWork& work, const Constants& constants,
                                       std::span<const std::int32_t> map) {
  table_ = upload_bytes(session_, std::as_bytes(std::span(work.scene.transfer_function.entries)));
  const technique::QuadratureTable table = technique::quadrature_table(work.scene);
  quadrature_ = upload_bytes(session_, std::as_bytes(std::span(table)));
  bricks_ = upload_bytes(session_, std::as_bytes(map));
  const auto drawn = static_cast<std::size_t>(
      technique::drawn_pixels(width_, height_, work.options.extra_work_stride));
  image_ = make_buffer(session_, CL_MEM_WRITE_ONLY, 4 * sizeof(float) * drawn);
  counters_ = make_buffer(session_, CL_MEM_WRITE_ONLY, counts_.size() * sizeof(std::uint32_t));
  std::vector<std::byte> parameters = technique::raycast_parameters(
      work.scene, work.options, stored_maximum(constants.voxel, constants.sampler));
  if (constants.parts) parameters.resize(parameters.size() + sizeof(technique::PartParameters));
  parameters_ = upload_bytes(session_, parameters);
}

Launch VolumeFrames::launch(const cl::Program& program, int columns) const {
  const auto width = static_cast<std::size_t>(columns);
  const auto height = static_cast<std::size_t>(height_);
  const cl::NDRange global(round_up(width, group_width), round_up(height, group_height));
  Launch launch =
      make_launch(program, "raycast", global, cl::NDRange(group_width, group_height), parameters_,
                  volume_, table_, bricks_, image_, counters_, quadrature_);
  const auto most = launch.kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(session_.device);
  if (most < group_width * group_height) launch.local = cl::NullRange;
  return launch;
}

void VolumeFrames::poison() {
  fill_buffer(session_, image_, measure::poison_word,
              checked([&] { return image_.getInfo<CL_MEM_SIZE>(); }));
  fill_buffer(session_, counters_, measure::poison_word, counts_.size() * sizeof(std::uint32_t));
}

measure::Frame VolumeFrames::frame(measure::Purpose purpose) {
  return checked([&] {
    const bool counts = purpose == measure::Purpose::counters;
    const std::vector<Launch>& launches = counts ? counting_ : timed_;
    measure::Frame frame =
        parts_ ? run_.draw(purpose, [&](auto& events) { parts_->run(launches.front(), events); })
               : run_.draw(session_, launches, purpose);
    if (counts) frame.counts = read_counters();
    return frame;  // OpenCL has no pipeline statistics, so none are reported
  });
}

technique::RayTrace VolumeFrames::trace(int x, int y) {
  if (constants_.cells) throw core::NotSupported(measure::pixel_history_unsupported);
  return checked([&] {
    const std::size_t counters = counts_.size();
    std::vector<std::uint32_t> words =
        technique::ray_trace_words_for(x, y, width_, counters / technique::raycast_counter_stride);
    const std::size_t bytes = words.size() * sizeof(std::uint32_t);
    const cl::Buffer records = make_buffer(session_, CL_MEM_READ_WRITE, bytes);
    write_buffer(session_, records, 0, bytes, words.data());
    Constants constants = constants_;
    constants.count = constants.trace = true;
    std::vector<Launch> launches{launch(
        programs_.get(program_source(source_files(constants)), constants.options()), width_)};
    launches.front().kernel.setArg(5, records);
    if (parts_) {
      launches.front().kernel.setArg(7, pauses_);
      static_cast<void>(run_.draw(measure::Purpose::counters,
                                  [&](auto& events) { parts_->run(launches.front(), events); }));
      run_.check();
    } else {
      run_checked(session_, launches);
    }
    read_buffer(session_, records, bytes, words.data());
    return technique::read_ray_trace(std::span(words).subspan(counters));
  });
}

record::Counts VolumeFrames::read_counters() {
  run_.check();
  read_buffer(session_, counters_, counts_.size() * sizeof(std::uint32_t), counts_.data());
  measure::check_counted(counts_);
  std::array<std::uint64_t, technique::raycast_counters.size()> sums{};
  for (std::size_t at = 0; at < counts_.size(); at += technique::raycast_counter_stride) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += counts_[at + i];
  }
  record::Counts counts;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    counts.emplace(technique::raycast_counters[i], sums[i]);
  }
  counts.emplace("rays", counts_.size() / technique::raycast_counter_stride);
  return counts;
}

core::Image VolumeFrames::image() {
  run_.check();
  core::Image image(width_, height_);
  read_buffer(session_, image_, image.rgba.size() * sizeof(float), image.rgba.data());
  return image;
}

}  // namespace triptych::opencl_backend
