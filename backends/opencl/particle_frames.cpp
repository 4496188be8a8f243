#include "backends/opencl/particle_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_set>

#include "core/error.hpp"

namespace triptych::opencl_backend {
namespace {

constexpr std::size_t cull_group = 64;
constexpr std::size_t counter_stride = 8;
// In the order of the kernels' counters.
constexpr std::array<std::string_view, 7> counter_names{"sprites",     "vertices",
                                                        "fragments",   "fragments_discarded",
                                                        "bin_entries", "particles_submitted",
                                                        "cells_culled"};

std::array<std::size_t, 2> tile_grid(const scene::ParticleScene& scene) {
  const auto tiles = [](int pixels) {
    return (static_cast<std::size_t>(pixels) + tile_edge - 1) / tile_edge;
  };
  return {tiles(scene.width), tiles(scene.height)};
}

std::size_t bin_count(const std::array<std::size_t, 2>& tiles) {
  const auto coarse = [](std::size_t n) { return (n + coarse_edge - 1) / coarse_edge; };
  return tiles[0] * tiles[1] + coarse(tiles[0]) * coarse(tiles[1]);
}

// Runs of cells that work items take: some for each compute unit, so that none waits long for the
// last.
std::size_t chunk_count(const Session& session) {
  constexpr std::size_t per_unit = 8;
  const auto units = checked([&] { return session.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>(); });
  return std::clamp<std::size_t>(per_unit * units, 16, 512);
}

}  // namespace

ParticleFrames::ParticleFrames(const Session& session, Programs& programs,
                               const measure::ParticleWork& work, Sprite sprite)
    : session_(session),
      width_(work.scene.width),
      height_(work.scene.height),
      near_(work.scene.camera.near),
      tiles_(tile_grid(work.scene)),
      bins_(bin_count(tiles_)),
      chunks_(chunk_count(session)),
      data_(upload(session, work)),
      counter_rows_(std::max({bins_, data_.cell_count, chunks_})) {
  ParticleConstants constants = constants_of(work, sprite);
  const std::string source = particle_source();
  hash_ = Programs::hash(source, constants.options());
  const cl::Program timed = programs.get(source, constants.options());
  constants.count = true;
  const cl::Program counting = programs.get(source, constants.options());
  checked([&] {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    camera_ = make_buffer(4 * data_.count);
    rectangles_ = make_buffer(2 * data_.count);
    sprite_colours_ = make_buffer(constants.transfer_at_pixel ? 0 : 4 * data_.count);
    cosines_ = make_buffer(constants.ray_at_vertex ? pixels : 0);
    visible_ = make_buffer(data_.cell_count);
    image_ = make_buffer(4 * pixels);
    ids_ = make_buffer(pixels);
    counters_ = make_buffer(counter_stride * counter_rows_);
    picture_ = make_pass(timed, 1);
    timed_.push_back(cull(timed));
    add_drawing(timed, picture_, timed_);
    timed_.push_back(shade(timed, picture_));
    counting_.push_back(cull(counting));
    add_drawing(counting, picture_, counting_);
    counting_.push_back(shade(counting, picture_));
    if (work.options.extra_work_stride > 0) {
      extra_ = make_pass(timed, static_cast<cl_uint>(work.options.extra_work_stride));
      add_drawing(timed, extra_, timed_);
    }
  });
}

cl::Buffer ParticleFrames::make_buffer(std::size_t words) const {
  return {session_.context, CL_MEM_READ_WRITE, std::max<std::size_t>(words, 4) * sizeof(cl_uint)};
}

// The camera stands still, so one round of binning tells how many entries there will ever be.
ParticleFrames::Pass ParticleFrames::make_pass(const cl::Program& program, cl_uint stride) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  Pass pass{.stride = stride,
            .list = make_buffer(data_.cell_count + 1),
            .counts = make_buffer(chunks_ * bins_),
            .totals = make_buffer(bins_),
            .begins = make_buffer(bins_ + 1),
            .depths = make_buffer(pixels),
            .winners = make_buffer(pixels)};
  std::vector<Launch> launches{cull(program)};
  add_binning(program, pass, launches);
  run(session_, launches, events_);
  std::vector<cl_uint> totals(bins_);
  session_.queue.enqueueReadBuffer(pass.totals, CL_TRUE, 0, bins_ * sizeof totals[0],
                                   totals.data());
  const std::uint64_t entries = std::reduce(totals.begin(), totals.end(), std::uint64_t{0});
  const std::uint64_t bytes = entries * sizeof(cl_uint);
  const auto most = session_.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  if (bytes > most) {
    throw core::NotSupported(fmt::format(
        "{} bin entries take {} bytes, CL_DEVICE_MAX_MEM_ALLOC_SIZE is {}", entries, bytes, most));
  }
  pass.entries = make_buffer(entries);
  return pass;
}

Launch ParticleFrames::cull(const cl::Program& program) const {
  const cl::NDRange cells(round_up(std::max<std::size_t>(data_.cell_count, 1), cull_group));
  return make_launch(program, "cull_cells", cells, cl::NDRange(cull_group), data_.parameters,
                     data_.cells, visible_, counters_);
}

void ParticleFrames::add_binning(const cl::Program& program, const Pass& pass,
                                 std::vector<Launch>& to) const {
  const cl::NDRange one(1);
  const auto bins = static_cast<cl_uint>(bins_);
  to.push_back(make_launch(program, "list_cells", one, one, data_.parameters, visible_, pass.stride,
                           pass.list));
  to.push_back(make_launch(program, "count_bins", cl::NDRange(chunks_), one, data_.parameters,
                           data_.spheres, data_.cells, pass.list, camera_, rectangles_,
                           data_.colours, data_.table, sprite_colours_, bins, pass.counts,
                           counters_));
  to.push_back(make_launch(program, "place_chunks", cl::NDRange(round_up(bins_, cull_group)),
                           cl::NDRange(cull_group), bins, static_cast<cl_uint>(chunks_),
                           pass.counts, pass.totals, counters_));
  to.push_back(make_launch(program, "place_bins", cl::NDRange(scan_items), cl::NDRange(scan_items),
                           bins, pass.totals, pass.begins));
}

void ParticleFrames::add_drawing(const cl::Program& program, const Pass& pass,
                                 std::vector<Launch>& to) const {
  const cl::NDRange one(1);
  add_binning(program, pass, to);
  to.push_back(make_launch(program, "fill_bins", cl::NDRange(chunks_), one, data_.parameters,
                           data_.cells, pass.list, rectangles_, static_cast<cl_uint>(bins_),
                           pass.counts, pass.begins, pass.entries));
  to.push_back(make_launch(program, "draw_tiles", cl::NDRange(tiles_[0], tiles_[1]),
                           cl::NDRange(1, 1), data_.parameters, camera_, rectangles_, pass.begins,
                           pass.entries, pass.depths, pass.winners, cosines_, counters_));
}

Launch ParticleFrames::shade(const cl::Program& program, const Pass& pass) const {
  return make_launch(program, "shade", cl::NDRange(static_cast<std::size_t>(height_)),
                     cl::NDRange(1), data_.parameters, camera_, data_.ids, data_.colours,
                     data_.table, sprite_colours_, pass.winners, cosines_, image_, ids_);
}

measure::Frame ParticleFrames::frame(measure::Purpose purpose) {
  return checked([&] {
    const bool counts = purpose == measure::Purpose::counters;
    if (counts) {
      session_.queue.enqueueFillBuffer(counters_, cl_uint{0}, 0,
                                       counter_stride * counter_rows_ * sizeof(cl_uint));
      session_.queue.finish();
    }
    measure::Frame frame;
    const auto begin = std::chrono::steady_clock::now();
    run(session_, counts ? counting_ : timed_, events_);
    const auto end = std::chrono::steady_clock::now();
    frame.wall_ns = std::chrono::duration<double, std::nano>(end - begin).count();
    if (purpose == measure::Purpose::timing) frame.device_ns = device_ns(events_);
    if (counts) frame.counts = read_counters();
    return frame;  // OpenCL has no pipeline statistics: they stay absent
  });
}

record::Counts ParticleFrames::read_counters() {
  std::vector<cl_uint> rows(counter_stride * counter_rows_);
  session_.queue.enqueueReadBuffer(counters_, CL_TRUE, 0, rows.size() * sizeof(cl_uint),
                                   rows.data());
  record::Counts counts;
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const std::size_t which = at % counter_stride;
    if (which < counter_names.size()) counts[std::string(counter_names.at(which))] += rows[at];
  }
  counts["cells"] = data_.cell_count;
  counts["particles_culled"] = data_.count - counts["particles_submitted"];
  counts["fragments_kept"] = counts["fragments"] - counts["fragments_discarded"];
  const core::Image picture = image();
  std::unordered_set<std::uint32_t> ids(picture.ids.begin(), picture.ids.end());
  ids.erase(core::Image::no_particle);
  counts["visible_ids"] = ids.size();
  return counts;
}

core::Image ParticleFrames::image() {
  core::Image image(width_, height_);
  image.ids.resize(image.pixel_count());
  image.depth.resize(image.pixel_count());
  checked([&] {
    const auto read = [&](const cl::Buffer& from, auto& to) {
      session_.queue.enqueueReadBuffer(from, CL_TRUE, 0, to.size() * sizeof to[0], to.data());
    };
    read(image_, image.rgba);
    read(ids_, image.ids);
    read(picture_.depths, image.depth);
  });
  for (float& z : image.depth) {
    z = z > 0 ? static_cast<float>(near_ / static_cast<double>(z))
              : std::numeric_limits<float>::infinity();
  }
  return image;
}

}  // namespace triptych::opencl_backend
