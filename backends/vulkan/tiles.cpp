// Spheres in compute: small ones drawn by an invocation each, large ones binned into tiles, nearest
// hit per pixel by depth and arrangement index.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/particle_target.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/tile_pipelines.hpp"
#include "core/error.hpp"
#include "technique/particles/tile_rounds.hpp"

namespace triptych::vulkan_backend {
namespace {

using technique::Culling;

// Bindings and sizes of technique/particles/tiles.glsl.
enum TileBinding : std::uint32_t {
  kept_spheres_binding = first_free_binding,
  kept_binding,
  tiles_binding,
  entries_binding,
  pixels_binding,
  cell_ends_binding,
  picture_binding,
  end_of_bindings
};
constexpr auto tile_edge = std::uint32_t{technique::tile_edge};
constexpr std::uint32_t group = 64;
constexpr vk::DeviceSize word = sizeof(std::uint32_t);
constexpr vk::DeviceSize tile_bytes = 4 * word;
constexpr vk::DeviceSize header_bytes = 4 * word;

struct RoundOf {  // shaders/tiles_prelude.glsl
  std::uint32_t first_cell;
  std::uint32_t cells;
};

std::uint32_t groups_for(std::uint32_t invocations, std::uint32_t size) {
  return (invocations + size - 1) / size;
}

std::vector<vk::DescriptorSetLayoutBinding> bindings() {
  auto all = particle_bindings();
  for (std::uint32_t binding = first_free_binding; binding < end_of_bindings; ++binding) {
    all.push_back(storage_binding(binding, vk::ShaderStageFlagBits::eCompute));
  }
  return all;
}

Buffer device_buffer(const Gpu& gpu, vk::DeviceSize bytes) {
  using enum vk::BufferUsageFlagBits;
  return {gpu, std::max<vk::DeviceSize>(bytes, tile_bytes),
          eStorageBuffer | eTransferSrc | eTransferDst, Place::device};
}

class TilesFrames final : public measure::Prepared {
 public:
  TilesFrames(const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work,
              const technique::Arrangement& arrangement);

  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return tiles_hash(constants_); }

 private:
  void bind() const;
  void run(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline, std::uint32_t x,
           std::uint32_t y = 1) const;
  void push(const vk::raii::CommandBuffer& commands, std::uint32_t first_cell,
            std::uint32_t cells) const;
  void record(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
              bool counting) const;
  void clear(const vk::raii::CommandBuffer& commands) const;
  void record_round(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
                    const technique::TileRound& round, std::uint32_t again) const;
  [[nodiscard]] core::Image read() const;

  const Gpu& gpu_;
  const Instance& instance_;
  technique::ParticleOptions options_;
  int width_;
  int height_;
  double near_;
  std::uint32_t columns_;  // of tiles
  std::uint32_t rows_;
  std::uint32_t pixels_count_;
  Specialization constants_;
  ParticleData data_;
  Buffer kept_spheres_;
  Buffer kept_;
  Buffer tiles_;
  Buffer pixels_;
  Buffer cell_ends_;
  Buffer picture_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;  // freed with the pool
  technique::TileRounds rounds_;
  Buffer entries_;
  TilePipelines pipelines_;
  std::optional<TilePipelines> counting_pipelines_;
  Frames frames_;
};

// With work planted, a particle may be kept twice.
std::uint64_t kept_places(const measure::ParticleWork& work) {
  return work.scene.particles->count() * (work.options.extra_work_stride > 0 ? 2 : 1);
}

// With work planted, a sphere may have each of its entries twice.
std::uint64_t entries_planted(const measure::ParticleWork& work) {
  return work.options.extra_work_stride > 0 ? 2 : 1;
}

// Throws core::NotSupported where one cell alone needs more entries than a buffer holds.
technique::TileRounds rounds_of(const Gpu& gpu, const measure::ParticleWork& work,
                                const technique::Arrangement& arrangement) {
  // A work group per cell in one dimension of a dispatch, of which every device takes so many.
  constexpr std::uint32_t most_cells = 65535;
  constexpr std::uint64_t enough_entries = std::uint64_t{1} << 24;
  const std::uint64_t most =
      gpu.properties.limits.maxStorageBufferRange / word / entries_planted(work);
  technique::TileRounds rounds =
      technique::tile_rounds(work.scene, arrangement, most_cells, std::min(most, enough_entries));
  if (rounds.entries > most) {
    throw core::NotSupported(
        fmt::format("one cell of particles needs {} entries in tiles; maxStorageBufferRange = {}",
                    rounds.entries, gpu.properties.limits.maxStorageBufferRange));
  }
  return rounds;
}

TilesFrames::TilesFrames(const Gpu& gpu, const Instance& instance,
                         const measure::ParticleWork& work,
                         const technique::Arrangement& arrangement)
    : gpu_(gpu),
      instance_(instance),
      options_(work.options),
      width_(work.scene.width),
      height_(work.scene.height),
      near_(work.scene.camera.near),
      columns_(groups_for(static_cast<std::uint32_t>(width_), tile_edge)),
      rows_(groups_for(static_cast<std::uint32_t>(height_), tile_edge)),
      pixels_count_(static_cast<std::uint32_t>(width_) * static_cast<std::uint32_t>(height_)),
      constants_(TileConstants{particle_constants(gpu, work),
                               static_cast<std::int32_t>(options_.culling)}),
      data_(gpu, work, arrangement),
      kept_spheres_(device_buffer(gpu, 4 * word * kept_places(work))),
      kept_(device_buffer(gpu, word * kept_places(work))),
      tiles_(device_buffer(gpu, header_bytes + tile_bytes * columns_ * rows_)),
      pixels_(device_buffer(gpu, 4 * word * pixels_count_)),
      cell_ends_(device_buffer(gpu, word * data_.cells())),
      picture_(device_buffer(gpu, 4 * word * pixels_count_)),
      layout_(make_layout(gpu, bindings(), sizeof(RoundOf))),
      pool_(make_pool(gpu, 1, end_of_bindings)),
      set_(allocate_sets(gpu, pool_, layout_, 1).front()),
      rounds_(rounds_of(gpu, work, arrangement)),
      entries_(device_buffer(gpu, word * rounds_.entries * entries_planted(work))),
      pipelines_(gpu, layout_, constants_, false),
      frames_((bind(), gpu), vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations,
              [this](const vk::raii::CommandBuffer& commands) {
                record(commands, pipelines_, false);
              }) {
  instance_.check_validation();
}

void TilesFrames::bind() const {
  data_.bind(set_, Fetch::by_index);
  const auto storage = [&](std::uint32_t binding, const Buffer& buffer) {
    bind_buffer(gpu_, set_, binding, vk::DescriptorType::eStorageBuffer, buffer);
  };
  storage(kept_spheres_binding, kept_spheres_);
  storage(kept_binding, kept_);
  storage(tiles_binding, tiles_);
  storage(entries_binding, entries_);
  storage(pixels_binding, pixels_);
  storage(cell_ends_binding, cell_ends_);
  storage(picture_binding, picture_);
}

void TilesFrames::run(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline,
                      std::uint32_t x, std::uint32_t y) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
  commands.dispatch(x, y, 1);
}

void TilesFrames::push(const vk::raii::CommandBuffer& commands, std::uint32_t first_cell,
                       std::uint32_t cells) const {
  commands.pushConstants<RoundOf>(*layout_.pipeline, vk::ShaderStageFlagBits::eCompute, 0,
                                  RoundOf{first_cell, cells});
}

void TilesFrames::clear(const vk::raii::CommandBuffer& commands) const {
  constexpr std::uint32_t none = 0xFFFFFFFF;
  const vk::DeviceSize plane = word * pixels_count_;
  commands.fillBuffer(tiles_.get(), 0, VK_WHOLE_SIZE, 0);
  for (const auto& [number, value] : {std::pair{0U, 0U}, {1U, none}, {2U, 0U}, {3U, none}}) {
    commands.fillBuffer(pixels_.get(), number * plane, plane, value);
  }
}

// Cells of the round `again` are binned twice: planted work that changes nothing.
void TilesFrames::record_round(const vk::raii::CommandBuffer& commands,
                               const TilePipelines& pipelines, const technique::TileRound& round,
                               std::uint32_t again) const {
  // Entries and large spheres of the round before, behind the count of small ones.
  commands.fillBuffer(tiles_.get(), word, 2 * word, 0);
  barrier(commands);
  push(commands, round.first, round.cells);
  run(commands, pipelines[TilePass::cells], groups_for(round.cells, group));
  barrier(commands);
  run(commands, pipelines[TilePass::bin], round.cells);
  if (again > 0) run(commands, pipelines[TilePass::bin], again);
  barrier(commands);
  if (round.entries > 0) {
    run(commands, pipelines[TilePass::place], groups_for(columns_ * rows_, group));
    barrier(commands);
    constexpr std::uint32_t fill_groups = 256;
    run(commands, pipelines[TilePass::fill], fill_groups);
    barrier(commands);
  }
  if (round.entries > 0 || options_.fault == technique::ParticleFault::missing_barrier) {
    run(commands, pipelines[TilePass::resolve], columns_, rows_);
  } else {
    run(commands, pipelines[TilePass::farthest], groups_for(columns_ * rows_, group));
  }
  barrier(commands);
}

void TilesFrames::record(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
                         bool counting) const {
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline, 0, set_, {});
  if (counting) data_.clear_counters(commands);
  clear(commands);
  barrier(commands);
  const auto stride = static_cast<std::uint32_t>(options_.extra_work_stride);
  std::uint32_t done = 0;
  for (const technique::TileRound& round : rounds_.rounds) {
    const std::uint32_t end = round.first + round.cells;
    const std::uint32_t due = stride == 0 || counting ? 0 : groups_for(end, stride) - done;
    const std::uint32_t again = std::min(due, round.cells);
    record_round(commands, pipelines, round, again);
    done += again;
  }
  constexpr std::uint32_t index_groups = 256;
  run(commands, pipelines[TilePass::index], index_groups);
  barrier(commands);
  run(commands, pipelines[TilePass::shade], groups_for(static_cast<std::uint32_t>(width_), 8),
      groups_for(static_cast<std::uint32_t>(height_), 8));
}

core::Image TilesFrames::read() const {
  core::Image image(width_, height_);
  download(gpu_, picture_, std::as_writable_bytes(std::span(image.rgba)));
  std::vector<std::uint32_t> planes(2 * image.pixel_count());
  download(gpu_, pixels_, std::as_writable_bytes(std::span(planes)));
  const auto middle = planes.begin() + static_cast<std::ptrdiff_t>(image.pixel_count());
  image.depth.resize(image.pixel_count());
  std::transform(planes.begin(), middle, image.depth.begin(),
                 [](std::uint32_t bits) { return std::bit_cast<float>(bits); });
  image.ids.assign(middle, planes.end());
  resolve_depth(image, near_);
  return image;
}

measure::Frame TilesFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !frames_.can_count()) {
      counting_pipelines_.emplace(gpu_, layout_, constants_, true);
      frames_.record_counters([this](const vk::raii::CommandBuffer& commands) {
        record(commands, *counting_pipelines_, true);
      });
    }
    measure::Frame frame = frames_.submit(purpose);
    if (counting) {
      frame.counts = data_.common_counts(options_.culling);
      frame.counts.emplace("vertices", 0);
      frame.counts.emplace("bin_entries", data_.counter(ParticleCounter::bin_entries));
      frame.counts.emplace("visible_ids", visible_ids(read()));
    }
    instance_.check_validation();
    return frame;
  });
}

core::Image TilesFrames::image() {
  return translated([&] {
    core::Image image = read();
    instance_.check_validation();
    return image;
  });
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_tiles(const Gpu& gpu, const Instance& instance,
                                                 const measure::ParticleWork& work) {
  return std::make_unique<TilesFrames>(gpu, instance, work, technique::arrange(work.scene));
}

}  // namespace triptych::vulkan_backend
