#include "backends/vulkan/hierarchy_tracer.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

using technique::Structure;

// The bindings of the shaders hierarchy.glsl and bvh.comp.glsl.
constexpr std::uint32_t boxes_binding = 7;
constexpr std::uint32_t tree_spheres_binding = 8;
constexpr std::uint32_t tree_order_binding = 9;
constexpr std::uint32_t sorted_binding = 10;
constexpr std::uint32_t scratch_binding = 12;
constexpr std::uint32_t box_texels_binding = 13;
constexpr std::uint32_t tree_sphere_texels_binding = 14;
constexpr std::uint32_t tree_order_texels_binding = 15;

// The passes that build the hierarchy, in the same order as `build_passes`.
enum class BuildPass : std::uint8_t { keys, count, rows, totals, scatter, leaves, level };
constexpr std::array<std::string_view, 7> build_passes{
    "hierarchy_keys.comp.spv",   "hierarchy_count.comp.spv",   "hierarchy_rows.comp.spv",
    "hierarchy_totals.comp.spv", "hierarchy_scatter.comp.spv", "hierarchy_leaves.comp.spv",
    "hierarchy_level.comp.spv"};
constexpr std::string_view timed_trace = "bvh.comp.spv";
constexpr std::string_view counting_trace = "bvh_counting.comp.spv";

// Flags in TRI_STEP.w of bvh.comp.glsl. A beam consists of the rays of 4×2 pixels, which one
// invocation traces. continues_beams resumes the traversals that an earlier dispatch did not
// finish, and leaves_beams stores where traversals stop.
constexpr std::uint32_t continues_beams = 1;
constexpr std::uint32_t leaves_beams = 2;

class HierarchyTracer final : public Tracer {
 public:
  HierarchyTracer(const Gpu& gpu, const measure::ParticleWork& work,
                  const technique::Arrangement& arrangement)
      : gpu_(gpu),
        options_(work.options),
        constants_(particle_constants(gpu, work)),
        hierarchy_(arrangement),
        grid_(technique::beam_grid(work.scene.width, work.scene.height)),
        boxes_(device_words(gpu, hierarchy_.box_words())),
        tree_spheres_(device_words(gpu, hierarchy_.sphere_words())),
        tree_order_(device_words(gpu, hierarchy_.order_words())),
        sorted_(device_words(gpu, hierarchy_.sorted_words())),
        scratch_(device_words(gpu, std::max<std::uint64_t>(hierarchy_.scratch_words(),
                                                           2 * std::uint64_t{grid_.beams()}))),
        box_texels_(texel_view(gpu, boxes_, vk::Format::eR32G32B32A32Sfloat)),
        sphere_texels_(texel_view(gpu, tree_spheres_, vk::Format::eR32G32B32A32Sfloat)),
        order_texels_(texel_view(gpu, tree_order_, vk::Format::eR32Uint)) {}

  [[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> bindings() const override;
  [[nodiscard]] std::uint32_t push_bytes() const override {
    return sizeof(technique::HierarchyParameters);
  }
  [[nodiscard]] bool counts_nodes() const override { return true; }
  void bind(vk::DescriptorSet set) const override;
  void prepare(const Layout& layout, vk::DescriptorSet set) override;
  void prepare_counting(const Layout& layout) override {
    counting_ = compute_pipeline(gpu_, layout, spirv(counting_trace), constants_);
  }
  void record(const vk::raii::CommandBuffer& commands, const Layout& layout,
              bool counting) const override;
  [[nodiscard]] std::vector<std::string_view> codes() const override {
    return {spirv(timed_trace)};
  }

 private:
  struct Step {
    BuildPass pass;
    std::uint32_t invocations;
    std::array<std::uint32_t, 4> values;
  };
  void run(const vk::raii::CommandBuffer& commands, const Layout& layout, vk::Pipeline pipeline,
           std::uint32_t invocations, const std::array<std::uint32_t, 4>& step) const;
  void run(const vk::raii::CommandBuffer& commands, const Layout& layout, const Step& step) const {
    run(commands, layout, build_.at(static_cast<std::size_t>(step.pass)), step.invocations,
        step.values);
  }
  void sort(const vk::raii::CommandBuffer& commands, const Layout& layout) const;
  void fit(const vk::raii::CommandBuffer& commands, const Layout& layout, bool refit) const;
  void trace_beams(const vk::raii::CommandBuffer& commands, const Layout& layout,
                   vk::Pipeline pipeline, std::uint32_t stride, std::uint32_t flags) const;
  [[nodiscard]] bool all_ended() const;

  const Gpu& gpu_;
  technique::ParticleOptions options_;
  Specialization constants_;
  technique::Hierarchy hierarchy_;
  technique::BeamGrid grid_;
  Buffer boxes_;
  Buffer tree_spheres_;
  Buffer tree_order_;
  Buffer sorted_;
  Buffer scratch_;
  vk::raii::BufferView box_texels_;
  vk::raii::BufferView sphere_texels_;
  vk::raii::BufferView order_texels_;
  std::vector<vk::Pipeline> build_;
  vk::Pipeline timed_;
  vk::Pipeline counting_;
  // The number of dispatches after which the traversals of all beams have ended.
  std::uint32_t rounds_ = 1;
};

std::vector<vk::DescriptorSetLayoutBinding> HierarchyTracer::bindings() const {
  std::vector<vk::DescriptorSetLayoutBinding> all;
  for (const std::uint32_t at :
       {boxes_binding, tree_spheres_binding, tree_order_binding, sorted_binding, scratch_binding}) {
    all.push_back(storage_binding(at, vk::ShaderStageFlagBits::eCompute));
  }
  for (std::uint32_t at = box_texels_binding; at <= tree_order_texels_binding; ++at) {
    all.push_back({.binding = at,
                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                   .descriptorCount = 1,
                   .stageFlags = vk::ShaderStageFlagBits::eCompute});
  }
  return all;
}

void HierarchyTracer::bind(vk::DescriptorSet set) const {
  const auto storage = [&](std::uint32_t binding, const Buffer& buffer) {
    bind_buffer(gpu_, set, binding, vk::DescriptorType::eStorageBuffer, buffer);
  };
  storage(boxes_binding, boxes_);
  storage(tree_spheres_binding, tree_spheres_);
  storage(tree_order_binding, tree_order_);
  storage(sorted_binding, sorted_);
  storage(scratch_binding, scratch_);
  bind_texels(gpu_, set, box_texels_binding, box_texels_);
  bind_texels(gpu_, set, tree_sphere_texels_binding, sphere_texels_);
  bind_texels(gpu_, set, tree_order_texels_binding, order_texels_);
}

void HierarchyTracer::run(const vk::raii::CommandBuffer& commands, const Layout& layout,
                          vk::Pipeline pipeline, std::uint32_t invocations,
                          const std::array<std::uint32_t, 4>& step) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
  commands.pushConstants<technique::HierarchyParameters>(
      *layout.pipeline, vk::ShaderStageFlagBits::eCompute, 0, hierarchy_.with_step(step));
  const auto [columns, group_rows] = technique::group_rows(invocations);
  commands.dispatch(columns, group_rows, 1);
  barrier(commands);
}

void HierarchyTracer::sort(const vk::raii::CommandBuffer& commands, const Layout& layout) const {
  constexpr std::uint32_t digits = 256;
  const std::uint32_t runs = hierarchy_.runs();
  run(commands, layout, {BuildPass::keys, hierarchy_.particles(), {}});
  for (const technique::SortPass& pass : technique::sort_passes(hierarchy_)) {
    const std::array<std::uint32_t, 4> values{pass.shift, pass.from, runs, 0};
    run(commands, layout, {BuildPass::count, runs, values});
    run(commands, layout, {BuildPass::rows, digits, values});
    run(commands, layout, {BuildPass::totals, 1, values});
    run(commands, layout, {BuildPass::scatter, runs, values});
  }
}

void HierarchyTracer::fit(const vk::raii::CommandBuffer& commands, const Layout& layout,
                          bool refit) const {
  run(commands, layout, {BuildPass::leaves, hierarchy_.leaves(), {refit ? 1U : 0U, 0, 0, 0}});
  for (std::uint32_t nodes = hierarchy_.leaves() / 2; nodes > 0; nodes /= 2) {
    run(commands, layout, {BuildPass::level, nodes, {nodes, 0, 0, 0}});
  }
}

// Traces every stride-th beam.
void HierarchyTracer::trace_beams(const vk::raii::CommandBuffer& commands, const Layout& layout,
                                  vk::Pipeline pipeline, std::uint32_t stride,
                                  std::uint32_t flags) const {
  run(commands, layout, pipeline, (grid_.beams() + stride - 1) / stride,
      {stride, grid_.columns, grid_.beams(), flags});
}

bool HierarchyTracer::all_ended() const {
  std::vector<std::uint32_t> states(2 * std::size_t{grid_.beams()});
  download(gpu_, scratch_, std::as_writable_bytes(std::span(states)));
  for (std::size_t beam = 0; beam < grid_.beams(); ++beam) {
    if (states[2 * beam] != 0) return false;
  }
  return true;
}

// Creates the pipelines, builds the hierarchy, and counts the dispatches that tracing needs.
// Because the camera does not move, every frame needs the same number of dispatches.
void HierarchyTracer::prepare(const Layout& layout, vk::DescriptorSet set) {
  for (const std::string_view pass : build_passes) {
    build_.push_back(compute_pipeline(gpu_, layout, spirv(pass), constants_));
  }
  timed_ = compute_pipeline(gpu_, layout, spirv(timed_trace), constants_);
  if (hierarchy_.particles() == 0) return;
  const auto bound = [&](const vk::raii::CommandBuffer& commands) {
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout.pipeline, 0, set, {});
  };
  run_once(gpu_, [&](const vk::raii::CommandBuffer& commands) {
    bound(commands);
    sort(commands, layout);
    fit(commands, layout, false);
    trace_beams(commands, layout, timed_, 1, leaves_beams);
  });
  while (gpu_.executes && !all_ended()) {
    ++rounds_;
    run_once(gpu_, [&](const vk::raii::CommandBuffer& commands) {
      bound(commands);
      trace_beams(commands, layout, timed_, 1, continues_beams | leaves_beams);
    });
  }
}

void HierarchyTracer::record(const vk::raii::CommandBuffer& commands, const Layout& layout,
                             bool counting) const {
  if (options_.structure == Structure::rebuilt) sort(commands, layout);
  if (options_.structure != Structure::built_once) {
    fit(commands, layout, options_.structure == Structure::refitted);
  }
  const vk::Pipeline pipeline = counting ? counting_ : timed_;
  const std::uint32_t keep_flag = rounds_ > 1 ? leaves_beams : 0;
  for (std::uint32_t round = 0; round < rounds_; ++round) {
    trace_beams(commands, layout, pipeline, 1, keep_flag | (round > 0 ? continues_beams : 0));
  }
  if (options_.extra_work_stride > 0 && !counting && rounds_ == 1) {
    trace_beams(commands, layout, pipeline, static_cast<std::uint32_t>(options_.extra_work_stride),
                0);
  }
}

}  // namespace

std::unique_ptr<Tracer> make_hierarchy_tracer(const Gpu& gpu, const measure::ParticleWork& work,
                                              const technique::Arrangement& arrangement,
                                              const ParticleData& /*data*/) {
  return std::make_unique<HierarchyTracer>(gpu, work, arrangement);
}

}  // namespace triptych::vulkan_backend
