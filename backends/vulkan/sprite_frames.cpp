#include "backends/vulkan/sprite_frames.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "backends/vulkan/errors.hpp"

namespace triptych::vulkan_backend {
namespace {

using technique::Culling;
using technique::ParticleFault;

vk::QueryPipelineStatisticFlags common_statistics() {
  using enum vk::QueryPipelineStatisticFlagBits;
  return eInputAssemblyVertices | eInputAssemblyPrimitives | eVertexShaderInvocations |
         eClippingInvocations | eClippingPrimitives | eFragmentShaderInvocations;
}

constexpr vk::ShaderStageFlags mesh_stages =
    vk::ShaderStageFlagBits::eTaskEXT | vk::ShaderStageFlagBits::eMeshEXT;

// Mesh pipelines have neither input assembly nor a vertex stage.
vk::QueryPipelineStatisticFlags statistics_of(const SpriteTechnique& technique) {
  using enum vk::QueryPipelineStatisticFlagBits;
  if (technique.draw.meshes) return eFragmentShaderInvocations | technique.statistics;
  return common_statistics() | technique.statistics;
}

void read_vertices(DrawState& state, scene::ColourKind colour) {
  state.vertex_bindings = {{.binding = 0, .stride = 16},
                           {.binding = 1, .stride = colour_bytes(colour)},
                           {.binding = 2, .stride = 4}};
  state.vertex_attributes = {
      {.location = 0, .binding = 0, .format = vk::Format::eR32G32B32A32Sfloat},
      {.location = 1, .binding = 1, .format = colour_format(colour)},
      {.location = 2, .binding = 2, .format = vk::Format::eR32Uint}};
}

}  // namespace

std::vector<vk::DescriptorSetLayoutBinding> SpriteFrames::bindings() const {
  auto all = particle_bindings();
  all.push_back(storage_binding(commands_binding, vk::ShaderStageFlagBits::eCompute));
  std::ranges::copy(occlusion_bindings(), std::back_inserter(all));
  if (!technique_.draw.meshes) return all;
  for (vk::DescriptorSetLayoutBinding& each : all) each.stageFlags |= mesh_stages;
  return all;
}

SpriteFrames::SpriteFrames(const Gpu& gpu, const Instance& instance,
                           const measure::ParticleWork& work,
                           const technique::Arrangement& arrangement, SpriteTechnique technique)
    : gpu_(gpu),
      instance_(instance),
      options_(work.options),
      colour_(work.scene.particles->colour),
      technique_(std::move(technique)),
      constants_(particle_constants(gpu, work)),
      data_(gpu, work, arrangement),
      target_(gpu, work.scene, options_.fault == ParticleFault::reversed_depth ? 1.0F : 0.0F),
      layout_(make_layout(gpu, bindings(), technique_.draw.meshes ? sizeof(std::uint32_t[2]) : 0,
                          vk::ShaderStageFlagBits::eTaskEXT)),
      pool_(make_pool(gpu, 1, static_cast<std::uint32_t>(bindings().size()))),
      set_(allocate_sets(gpu, pool_, layout_, 1).front()),
      culling_(gpu, layout_, data_.cells(), technique_.draw.instanced, options_.culling,
               constants_),
      draws_(draws(false)),
      frames_(
          (bind(), gpu), statistics_of(technique_),
          [this](const vk::raii::CommandBuffer& commands) { record(commands, draws_, false); }) {
  if (occlusion_ && gpu.executes) draw_before(work);
  instance_.check_validation();
}

// Draws a frame from the previous camera, which is not measured. It is needed because occlusion
// culling in the first measured frame uses the cells that were visible in the frame before it.
void SpriteFrames::draw_before(const measure::ParticleWork& work) const {
  if (work.camera_before) data_.upload_camera(work.before());
  static_cast<void>(frames_.submit(measure::Purpose::timing));
  if (work.camera_before) data_.upload_camera(work);
}

// Draws two frames, after which the set of hidden cells (ranges of neighbouring particles) no
// longer changes. The first frame after a jump of the camera draws everything that is visible. The
// second frame skips the hidden cells, and all later frames do the same work as the second.
void SpriteFrames::settle() const {
  for (int frame = 0; frame < 2; ++frame) {
    static_cast<void>(frames_.submit(measure::Purpose::timing));
  }
}

void SpriteFrames::bind() {
  const bool instanced =
      technique_.draw.instanced || technique_.draw.meshes || technique_.rest.has_value();
  data_.bind(set_, instanced ? Fetch::by_index : Fetch::attributes);
  culling_.bind(set_);
  if (options_.culling != Culling::occlusion) return;
  occlusion_.emplace(gpu_, layout_, data_.cells(), target_.extent(), constants_);
  occlusion_->bind(set_);
}

std::string_view SpriteFrames::pixel_stage(bool counting) const {
  std::string name = "sphere";
  if (options_.fault == ParticleFault::wrong_sense) {
    name += "_wrong_sense";
  } else if (options_.conservative_depth) {
    name += "_conservative";
  }
  return spirv(name + (counting ? "_counting" : "") + ".frag.spv");
}

DrawState SpriteFrames::draw_state(const SpriteDraw& draw, bool counting) const {
  DrawState state{.topology = draw.topology,
                  .colour_targets = ParticleTarget::colour_targets,
                  .depth = depth_compare(options_.fault),
                  .extent = target_.extent(),
                  .formats = ParticleTarget::formats()};
  for (const SpriteStage& each : draw.stages) {
    state.stages.push_back({each.stage, spirv(counting ? each.counting : each.timed)});
  }
  state.stages.push_back({vk::ShaderStageFlagBits::eFragment, pixel_stage(counting)});
  if (!draw.instanced && !draw.meshes) read_vertices(state, colour_);
  return state;
}

SpriteFrames::Draws SpriteFrames::draws(bool counting) const {
  const auto make = [&](const SpriteDraw& draw) {
    return draw_pipeline(gpu_, layout_, target_.pass(), draw_state(draw, counting), constants_);
  };
  Draws draws{.draw = make(technique_.draw), .later = {}, .rest = {}};
  draws.later = draws.draw;
  if (technique_.later) draws.later = make(*technique_.later);
  if (technique_.rest && !technique_.rest_runs.empty()) draws.rest = make(*technique_.rest);
  return draws;
}

void SpriteFrames::record(const vk::raii::CommandBuffer& commands, const Draws& draws,
                          bool counting) const {
  for (const auto point : {vk::PipelineBindPoint::eCompute, vk::PipelineBindPoint::eGraphics}) {
    commands.bindDescriptorSets(point, *layout_.pipeline, 0, set_, {});
  }
  if (counting) data_.clear_counters(commands);
  if (occlusion_) {
    occlusion_->start_frame(commands);
    if (!technique_.draw.meshes) culling_.record(commands, CullPass::visible_before, counting);
  } else if (options_.culling == Culling::frustum && !technique_.draw.meshes) {
    culling_.record(commands, CullPass::view, counting);
  }
  const Label label(gpu_, commands, "draw sprites");
  target_.begin(commands, false);
  if (data_.particles() > 0) draw(commands, draws, counting);
  commands.endRenderPass();
  if (occlusion_) draw_newly_visible(commands, draws, counting);
}

void SpriteFrames::draw_newly_visible(const vk::raii::CommandBuffer& commands, const Draws& draws,
                                      bool counting) const {
  const Label label(gpu_, commands, "draw newly visible cells");
  occlusion_->find_farthest(commands, target_.depth());
  if (technique_.draw.meshes) {
    target_.begin(commands, true);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, draws.later);
    draw_meshes(commands, {1, 1});
    commands.endRenderPass();
    return;
  }
  culling_.record(commands, CullPass::newly_visible, counting);
  target_.begin(commands, true);
  bind_vertices(commands, draws);
  culling_.draw(commands, 1);
  commands.endRenderPass();
}

void SpriteFrames::bind_vertices(const vk::raii::CommandBuffer& commands,
                                 const Draws& draws) const {
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, draws.draw);
  const std::array<vk::DeviceSize, 3> offsets{};
  if (technique_.draw.meshes) return;
  const std::array buffers{data_.spheres().get(), data_.colours().get(), data_.ids().get()};
  commands.bindVertexBuffers(0, buffers, offsets);
}

void SpriteFrames::draw(const vk::raii::CommandBuffer& commands, const Draws& draws,
                        bool counting) const {
  bind_vertices(commands, draws);
  if (technique_.draw.meshes) {
    draw_meshes(commands, {1, 1});
  } else if (options_.culling == Culling::none) {
    draw_run(commands, technique_.draw.instanced, {0, data_.particles()});
  } else {
    culling_.draw(commands, 1);
  }
  if (options_.extra_work_stride > 0 && !counting) draw_again(commands);
  if (draws.rest) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, draws.rest);
    for (const ParticleRun& run : technique_.rest_runs) {
      draw_run(commands, technique_.rest->instanced, run);
    }
  }
}

void SpriteFrames::draw_meshes(const vk::raii::CommandBuffer& commands,
                               const std::array<std::uint32_t, 2>& share) const {
  constexpr std::uint32_t cells_per_group = 32;  // as in mesh.task.glsl
  const std::uint32_t cells = (data_.cells() + share[0] - 1) / share[0];
  commands.pushConstants<std::array<std::uint32_t, 2>>(*layout_.pipeline,
                                                       vk::ShaderStageFlagBits::eTaskEXT, 0, share);
  commands.drawMeshTasksEXT((cells + cells_per_group - 1) / cells_per_group, 1, 1);
}

void SpriteFrames::draw_run(const vk::raii::CommandBuffer& commands, bool instanced,
                            ParticleRun run) const {
  if (instanced) {
    commands.draw(4, run.count, 0, run.begin);
  } else {
    commands.draw(run.count, 1, run.begin, 0);
  }
}

// Draws the injected extra work: 1/stride of the particles a second time. Draws whole cells if
// there are enough of them, so that culled cells stay culled. The image does not change, because
// the depth test keeps the first of two equal depths.
void SpriteFrames::draw_again(const vk::raii::CommandBuffer& commands) const {
  const auto stride = static_cast<std::uint32_t>(options_.extra_work_stride);
  if (technique_.draw.meshes) {
    const bool whole_cells = data_.cells() >= 8 * stride;
    draw_meshes(commands, {whole_cells ? stride : 1, whole_cells ? 1 : stride});
    return;
  }
  if (options_.culling != Culling::none && data_.cells() >= 8 * stride) {
    culling_.draw(commands, stride);
    return;
  }
  // Uses only a few draws, because every draw costs several microseconds on lavapipe.
  constexpr std::uint32_t most_runs = 4;
  const std::uint32_t particles = data_.particles();
  const std::uint32_t length = std::max(particles / stride / most_runs, 1U);
  for (std::uint32_t begin = 0; begin < particles;) {
    draw_run(commands, technique_.draw.instanced, {begin, std::min(length, particles - begin)});
    if (particles - begin <= length * stride) break;
    begin += length * stride;
  }
}

void SpriteFrames::poison() {
  translated([&] {
    target_.poison(gpu_);
    data_.poison_counters();
    culling_.poison();
  });
}

measure::Frame SpriteFrames::frame(measure::Purpose purpose) {
  return translated([&] {
    const bool counting = purpose == measure::Purpose::counters;
    if (counting && !frames_.can_count()) {
      counting_draws_ = draws(true);
      frames_.record_counters([this](const vk::raii::CommandBuffer& commands) {
        record(commands, counting_draws_, true);
      });
    }
    if (counting && occlusion_) {
      settle();
      poison();
    }
    measure::Frame frame = frames_.submit(purpose);
    if (counting) {
      frame.counts = data_.counts(technique::Method::sprites, options_.culling, target_.read(gpu_));
    }
    instance_.check_validation();
    return frame;
  });
}

core::Image SpriteFrames::image() {
  return translated([&] {
    core::Image image = target_.read(gpu_);
    instance_.check_validation();
    return image;
  });
}

std::string SpriteFrames::kernel_hash() const {
  std::vector<std::string_view> codes;
  for (const SpriteStage& each : technique_.draw.stages) codes.push_back(spirv(each.timed));
  codes.push_back(pixel_stage(false));
  return code_hash(codes, constants_);
}

std::unique_ptr<measure::Prepared> prepare_sprites(const Gpu& gpu, const Instance& instance,
                                                   const measure::ParticleWork& work,
                                                   SpriteTechnique technique) {
  return std::make_unique<SpriteFrames>(gpu, instance, work, technique::arrange(work.scene),
                                        std::move(technique));
}

}  // namespace triptych::vulkan_backend
