#include "backends/opencl/particle_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "measure/contract/not_drawn.hpp"

namespace triptych::opencl_backend {
namespace {

constexpr std::size_t group = 64;
// Cell states of particle_cull.cl.
constexpr cl_uint drawn_first = 1;
constexpr cl_uint drawn_later = 2;

std::array<std::size_t, 2> tile_grid(const scene::ParticleScene& scene) {
  const auto tiles = [](int pixels) {
    return (static_cast<std::size_t>(pixels) + tile_edge - 1) / tile_edge;
  };
  return {tiles(scene.width), tiles(scene.height)};
}

}  // namespace

ParticleStages::ParticleStages(const Session& session, ParticleData data,
                               const measure::ParticleWork& work,
                               const ParticleConstants& constants)
    : session_(session),
      culling_(work.options.culling),
      colours_sprites_(!constants.transfer_at_pixel),
      sprite_(constants.sprite),
      height_(static_cast<std::size_t>(work.scene.height)),
      pixels_(static_cast<std::size_t>(work.scene.width) * height_),
      tiles_(tile_grid(work.scene)),
      table_(bin_table(work.scene.width, work.scene.height, work.scene.particles->count())),
      data_(std::move(data)),
      counter_rows_(std::max({table_.bins, data_.cell_count, table_.chunks})),
      stored_(stored_words(sprite_) > 0 ? make_buffer(stored_words(sprite_) * data_.count)
                                        : cl::Buffer()),
      patches_(patch_words(sprite_) > 0 ? make_buffer(patch_words(sprite_) * data_.count)
                                        : cl::Buffer()),
      camera_(make_buffer(4 * data_.count)),
      rectangles_(make_buffer(2 * data_.count)),
      sprite_colours_(make_buffer(colours_sprites_ ? 4 * data_.count : 0)),
      cosines_(make_buffer(constants.ray_at_vertex ? pixels_ : 0)),
      visible_before_(make_buffer(data_.cell_count)),
      states_(make_buffer(data_.cell_count)),
      farthest_(make_buffer(tiles_[0] * tiles_[1])),
      image_(make_buffer(4 * pixels_)),
      ids_(make_buffer(pixels_)),
      counters_(make_buffer(particle_counter_stride * counter_rows_)) {
  mark_all_visible();
}

cl::Buffer ParticleStages::make_buffer(std::size_t words) const {
  constexpr std::size_t fewest = 4;  // OpenCL does not allow empty buffers
  return checked([&] {
    return opencl_backend::make_buffer(session_, CL_MEM_READ_WRITE,
                                       std::max(words, fewest) * sizeof(cl_uint));
  });
}

cl::NDRange ParticleStages::cell_range() const {
  return cl::NDRange(round_up(std::max<std::size_t>(data_.cell_count, 1), group));
}

void ParticleStages::mark_all_visible() const {
  fill_buffer(session_, visible_before_, 1,
              std::max<std::size_t>(data_.cell_count, 1) * sizeof(cl_uint));
}

Pass ParticleStages::make_pass(const ParticlePrograms& programs, cl_uint stride) {
  Pass pass{.stride = stride,
            .list = make_buffer(data_.cell_count + 1),
            .counts = make_buffer(table_.words()),
            .totals = make_buffer(table_.bins),
            .begins = make_buffer(table_.bins + 1),
            .entries = make_buffer(0),
            .depths = make_buffer(pixels_),
            .winners = make_buffer(pixels_)};
  // The buffer for entries is made large enough for all visible cells (ranges of neighbouring
  // particles). If the stride is greater than 1, a pass draws only some of these cells, but
  // occlusion culling may select other cells in each frame.
  Pass whole = pass;
  whole.stride = 1;
  std::vector<Launch> launches{cull(programs)};
  add_binning(programs, whole, drawn_first, launches);
  if (!session_.queue.executes()) return pass;
  run_checked(session_, launches);
  std::vector<cl_uint> totals(table_.bins);
  read_buffer(session_, pass.totals, table_.bins * sizeof totals[0], totals.data());
  const std::uint64_t entries = std::reduce(totals.begin(), totals.end(), std::uint64_t{0});
  const std::uint64_t bytes = entries * sizeof(cl_uint);
  const auto most = session_.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  if (bytes > most) {
    throw core::NotSupported(fmt::format(
        "{} bin entries (one for each image tile that a particle overlaps) need {} bytes, "
        "but CL_DEVICE_MAX_MEM_ALLOC_SIZE is {}",
        entries, bytes, most));
  }
  pass.entries = make_buffer(entries);
  return pass;
}

void ParticleStages::poison(const Pass& pass) const {
  const auto fill = [&](const cl::Buffer& buffer, cl_uint word) {
    fill_buffer(session_, buffer, word, checked([&] { return buffer.getInfo<CL_MEM_SIZE>(); }));
  };
  for (const cl::Buffer* each : {&image_, &ids_, &pass.depths, &camera_}) {
    fill(*each, measure::poison_word);
  }
  // Kernels use the contents of these buffers as counts and indices, so they are set to 0 instead
  // of the poison value. The kernels then draw nothing.
  for (const cl::Buffer* each : {&pass.list, &pass.begins, &pass.totals, &rectangles_}) {
    fill(*each, 0);
  }
}

Launch ParticleStages::cull(const ParticlePrograms& programs) const {
  const cl_uint culling = culling_ == technique::Culling::none ? 0 : 1;
  return make_launch(programs.cells, "cull_cells", cell_range(), cl::NDRange(group),
                     data_.parameters, data_.cells, culling, visible_before_, states_, counters_);
}

Launch ParticleStages::test(const ParticlePrograms& programs) const {
  return make_launch(programs.cells, "test_cells", cell_range(), cl::NDRange(group),
                     data_.parameters, data_.cells, farthest_, visible_before_, states_, counters_);
}

void ParticleStages::add_binning(const ParticlePrograms& programs, const Pass& pass, cl_uint state,
                                 std::vector<Launch>& to) const {
  const cl::NDRange one(1);
  const auto bins = static_cast<cl_uint>(table_.bins);
  to.push_back(make_launch(programs.cells, "list_cells", one, one, data_.parameters, states_, state,
                           pass.stride, pass.list));
  add_expansion(programs, pass, to);
  to.push_back(make_launch(programs.sprites, "count_bins", cl::NDRange(table_.chunks), one,
                           data_.parameters, data_.spheres, data_.cells, pass.list, camera_,
                           rectangles_, bins, pass.counts, counters_));
  add_stored(to.back());
  to.push_back(make_launch(
      programs.cells, "place_chunks", cl::NDRange(round_up(table_.bins, group)), cl::NDRange(group),
      bins, static_cast<cl_uint>(table_.chunks), pass.counts, pass.totals, counters_));
  to.push_back(make_launch(programs.cells, "place_bins", cl::NDRange(scan_items),
                           cl::NDRange(scan_items), bins, pass.totals, pass.begins));
}

void ParticleStages::add_expansion(const ParticlePrograms& programs, const Pass& pass,
                                   std::vector<Launch>& to) const {
  const cl::NDRange one(1);
  const cl::NDRange chunks(table_.chunks);
  const auto add = [&](const char* kernel, const auto&... arguments) {
    to.push_back(
        make_launch(programs.sprites, kernel, chunks, one, data_.parameters, arguments...));
  };
  switch (sprite_) {
    case Sprite::expanded_quad:
      add("expand_sprites", data_.spheres, data_.cells, pass.list, stored_);
      return;
    case Sprite::evaluated_quad:
      add("control_patches", data_.spheres, data_.cells, pass.list, patches_);
      add("evaluate_patches", data_.cells, pass.list, patches_, stored_);
      return;
    case Sprite::point:
      add("project_points", data_.spheres, data_.cells, pass.list, stored_);
      return;
    case Sprite::rectangle:
    case Sprite::screen_quad:
    case Sprite::ray_quad:
    case Sprite::polygon:
    case Sprite::adaptive_polygon:
      return;
  }
}

void ParticleStages::add_stored(Launch& launch) const {
  if (stored_words(sprite_) == 0) return;
  const auto last = launch.kernel.getInfo<CL_KERNEL_NUM_ARGS>() - 1;
  launch.kernel.setArg(last, stored_);
}

void ParticleStages::add_drawing(const ParticlePrograms& programs, const Pass& pass, cl_uint state,
                                 std::vector<Launch>& to) const {
  const cl::NDRange one(1);
  const cl_uint later = state == drawn_later ? 1 : 0;
  add_binning(programs, pass, state, to);
  to.push_back(make_launch(programs.sprites, "fill_bins", cl::NDRange(table_.chunks), one,
                           data_.parameters, data_.cells, pass.list, rectangles_,
                           static_cast<cl_uint>(table_.bins), pass.counts, pass.begins,
                           pass.entries));
  if (colours_sprites_) {
    to.push_back(make_launch(programs.shading, "colour_sprites", cl::NDRange(table_.chunks), one,
                             data_.cells, pass.list, data_.colours, data_.table, sprite_colours_));
  }
  to.push_back(make_launch(programs.sprites, "draw_tiles", cl::NDRange(tiles_[0], tiles_[1]),
                           cl::NDRange(1, 1), data_.parameters, camera_, rectangles_, pass.begins,
                           pass.entries, later, farthest_, pass.depths, pass.winners, cosines_,
                           counters_));
  add_stored(to.back());
}

Launch ParticleStages::shade(const ParticlePrograms& programs, const Pass& pass) const {
  return make_launch(programs.shading, "shade", cl::NDRange(height_), cl::NDRange(1),
                     data_.parameters, camera_, data_.ids, data_.colours, data_.table,
                     sprite_colours_, pass.winners, cosines_, image_, ids_);
}

std::vector<Launch> ParticleStages::frame_launches(const ParticlePrograms& programs,
                                                   const Pass& pass) const {
  std::vector<Launch> launches{cull(programs)};
  add_drawing(programs, pass, drawn_first, launches);
  if (culling_ == technique::Culling::occlusion) {
    launches.push_back(test(programs));
    add_drawing(programs, pass, drawn_later, launches);
  }
  launches.push_back(shade(programs, pass));
  return launches;
}

std::vector<Launch> ParticleStages::extra_launches(const ParticlePrograms& programs,
                                                   const Pass& pass) const {
  std::vector<Launch> launches;
  add_drawing(programs, pass, drawn_first, launches);
  return launches;
}

}  // namespace triptych::opencl_backend
