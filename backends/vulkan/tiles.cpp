// Draws each small sphere in one invocation, and sorts large spheres into tiles in compute shaders.
// The nearest hit of each pixel is selected by depth and then by the index in
// technique::Arrangement (technique/particles/tiles.glsl describes the passes).
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/particle_target.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/tile_buffers.hpp"
#include "backends/vulkan/tile_pipelines.hpp"
#include "core/error.hpp"
#include "technique/particles/tile_rounds.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint32_t tile_group_size = 64;

struct RoundOf {  // as in shaders/tiles_prelude.glsl
  std::uint32_t first_cell;
  std::uint32_t cells;
};

vk::QueryPipelineStatisticFlags tile_statistics() {
  return vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations;
}

std::uint32_t groups_for(std::uint32_t invocations, std::uint32_t size) {
  return (invocations + size - 1) / size;
}

class TilesFrames final : public measure::Prepared {
 public:
  TilesFrames(const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work,
              const technique::Arrangement& arrangement);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override { return tiles_hash(constants_); }

 private:
  void bind() const;
  void run(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline,
           std::uint32_t groups) const;
  void push(const vk::raii::CommandBuffer& commands, std::uint32_t first_cell,
            std::uint32_t cells) const;
  void record(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
              bool counting) const;
  void bin(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
           const technique::TileRound& round, std::uint32_t extra_cells) const;
  void resolve(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
               const technique::TileRound& round) const;
  void show(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines) const;

  const Gpu& gpu_;
  const Instance& instance_;
  technique::ParticleOptions options_;
  technique::TileRounds rounds_;
  Specialization constants_;
  ParticleData data_;
  TileBuffers buffers_;
  std::uint32_t tile_groups_;  // work groups with one invocation per tile
  ParticleTarget target_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;  // freed with the pool
  TilePipelines pipelines_;
  vk::Pipeline show_;
  std::optional<TilePipelines> counting_pipelines_;
  Frames frames_;
};

// Divides the frame into rounds, each of which processes a range of cells (ranges of neighbouring
// particles). Throws core::NotSupported if a single cell needs more entries (pairs of a tile and a
// large sphere) than a buffer can have.
technique::TileRounds rounds_of(const Gpu& gpu, const measure::ParticleWork& work,
                                const technique::Arrangement& arrangement) {
  // A dispatch has one work group per cell, all along one dimension. Every device supports this
  // number of work groups.
  constexpr std::uint32_t most_cells = 65535;
  constexpr std::uint64_t enough_entries = std::uint64_t{1} << 24;
  const std::uint64_t times = work.options.extra_work_stride > 0 ? 2 : 1;
  const std::uint64_t most =
      gpu.properties.limits.maxStorageBufferRange / sizeof(std::uint32_t) / times;
  technique::TileRounds rounds =
      technique::tile_rounds(work.scene, arrangement, most_cells, std::min(most, enough_entries));
  if (const auto reason = technique::passes_reason(rounds)) throw core::NotSupported(*reason);
  if (rounds.entries > most) {
    throw core::NotSupported(fmt::format(
        "one cell (a group of neighbouring particles) needs {} bytes for its list of tiles and "
        "spheres, but maxStorageBufferRange is {} bytes",
        rounds.entries * times * sizeof(std::uint32_t),
        gpu.properties.limits.maxStorageBufferRange));
  }
  return rounds;
}

TilesFrames::TilesFrames(const Gpu& gpu, const Instance& instance,
                         const measure::ParticleWork& work,
                         const technique::Arrangement& arrangement)
    : gpu_(gpu),
      instance_(instance),
      options_(work.options),
      rounds_(rounds_of(gpu, work, arrangement)),
      constants_(TileConstants{particle_constants(gpu, work),
                               static_cast<std::int32_t>(options_.culling), rounds_.spheres()}),
      data_(gpu, work, arrangement),
      buffers_(gpu, work, data_, rounds_),
      tile_groups_(groups_for(buffers_.tiles(), tile_group_size)),
      target_(gpu, work.scene,
              options_.fault == technique::ParticleFault::reversed_depth ? 1.0F : 0.0F),
      layout_(make_layout(gpu, tile_bindings(), sizeof(RoundOf))),
      pool_(tile_pool(gpu)),
      set_(allocate_sets(gpu, pool_, layout_, 1).front()),
      pipelines_(gpu, layout_, constants_, false),
      show_(tiles_show(gpu, layout_, target_.pass(),
                       {.colour_targets = ParticleTarget::colour_targets,
                        .depth = depth_compare(options_.fault),
                        .extent = target_.extent(),
                        .formats = ParticleTarget::formats()},
                       constants_)),
      frames_((bind(), gpu), tile_statistics(), [this](const vk::raii::CommandBuffer& commands) {
        record(commands, pipelines_, false);
      }) {
  instance_.check_validation();
}

void TilesFrames::bind() const {
  data_.bind(set_, Fetch::by_index);
  buffers_.bind(set_);
}

void TilesFrames::run(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline,
                      std::uint32_t groups) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
  commands.dispatch(groups, 1, 1);
}

void TilesFrames::push(const vk::raii::CommandBuffer& commands, std::uint32_t first_cell,
                       std::uint32_t cells) const {
  commands.pushConstants<RoundOf>(*layout_.pipeline, vk::ShaderStageFlagBits::eCompute, 0,
                                  RoundOf{first_cell, cells});
}

// If `extra_cells` is not 0, sorts that many cells of the round a second time. This injected extra
// work does not change the image.
void TilesFrames::bin(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
                      const technique::TileRound& round, std::uint32_t extra_cells) const {
  const Label label(gpu_, commands, "tiles: cull cells and bin their spheres");
  push(commands, round.first, round.cells);
  run(commands, pipelines[TilePass::cells], groups_for(round.cells, tile_group_size));
  barrier(commands);
  run(commands, pipelines[TilePass::bin], round.cells);
  if (extra_cells > 0) run(commands, pipelines[TilePass::bin], extra_cells);
  barrier(commands);
}

// Draws the round's large spheres, unless the final pass draws them, and computes the farthest
// depth of each tile.
void TilesFrames::resolve(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
                          const technique::TileRound& round) const {
  const Label label(gpu_, commands, "tiles: fill the sphere lists and find the nearest hits");
  run(commands, pipelines[TilePass::place], tile_groups_);
  barrier(commands);
  if (round.entries > 0) {
    run(commands, pipelines[TilePass::fill], technique::list_groups(data_.particles()));
    barrier(commands);
  }
  if (rounds_.at_once) return;
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipelines[TilePass::resolve]);
  buffers_.dispatch_listed(commands);
  barrier(commands);
}

void TilesFrames::show(const vk::raii::CommandBuffer& commands,
                       const TilePipelines& pipelines) const {
  const Label label(gpu_, commands, "tiles: shade the nearest hits");
  if (rounds_.small) {
    run(commands, pipelines[TilePass::index], technique::list_groups(data_.particles()));
    barrier(commands);
  }
  target_.begin(commands, false);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, show_);
  commands.draw(4, buffers_.blocks(), 0, 0);
  commands.endRenderPass();
}

void TilesFrames::record(const vk::raii::CommandBuffer& commands, const TilePipelines& pipelines,
                         bool counting) const {
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_.pipeline, 0, set_, {});
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_.pipeline, 0, set_, {});
  if (counting) data_.clear_counters(commands);
  buffers_.clear(commands);
  barrier(commands);
  const auto stride = static_cast<std::uint32_t>(options_.extra_work_stride);
  std::uint32_t done = 0;
  for (const technique::TileRound& round : rounds_.rounds) {
    const std::uint32_t end = round.first + round.cells;
    const std::uint32_t due = stride == 0 || counting ? 0 : groups_for(end, stride) - done;
    const std::uint32_t extra_cells = std::min(due, round.cells);
    done += extra_cells;
    buffers_.start_round(commands);
    bin(commands, pipelines, round, extra_cells);
    const bool last = &round == &rounds_.rounds.back();
    if (!last || round.entries > 0) resolve(commands, pipelines, round);
    if (!last) {
      run(commands, pipelines[TilePass::settle], tile_groups_);
      barrier(commands);
    }
  }
  show(commands, pipelines);
}

void TilesFrames::poison() {
  translated([&] {
    target_.poison(gpu_);
    data_.poison_counters();
    buffers_.poison();
  });
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
      frame.counts = data_.counts(technique::Method::tiles, options_.culling, target_.read(gpu_));
    }
    instance_.check_validation();
    return frame;
  });
}

core::Image TilesFrames::image() {
  return translated([&] {
    core::Image image = target_.read(gpu_);
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
