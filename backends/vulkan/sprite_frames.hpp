#pragma once
// The techniques that draw sprites with the rasterizer. They differ in the stages that generate the
// sprites.

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "backends/vulkan/cell_culling.hpp"
#include "backends/vulkan/cell_occlusion.hpp"
#include "backends/vulkan/draw_pipeline.hpp"
#include "backends/vulkan/frames.hpp"
#include "backends/vulkan/instance.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/particle_target.hpp"

namespace triptych::vulkan_backend {

// A stage before the fragment stage, with the names of two SPIR-V files: one that is used for
// timing, and one that also counts its work.
struct SpriteStage {
  vk::ShaderStageFlagBits stage;
  std::string_view timed;
  std::string_view counting;
};

// One draw of a frame, with the stages that turn particles into sprites.
struct SpriteDraw {
  std::vector<SpriteStage> stages;
  // If true, a draw has four vertices per particle and no vertex buffer. Otherwise, it has one
  // vertex per particle.
  bool instanced = false;
  // If true, the stages are task and mesh stages, and there are no vertices. The task stage culls
  // the cells (ranges of neighbouring particles) itself.
  bool meshes = false;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::ePointList;
};

// A run of consecutive particles in the order of technique::Arrangement.
struct ParticleRun {
  std::uint32_t begin = 0;
  std::uint32_t count = 0;
};

struct SpriteTechnique {
  SpriteDraw draw;
  // The statistics of the technique's own stages, in addition to those of all sprite techniques.
  vk::QueryPipelineStatisticFlags statistics;
  // The draw of the second pass of occlusion culling, if its stages differ from those of the first
  // pass.
  std::optional<SpriteDraw> later;
  // The second draw, which covers only the particles in rest_runs. The technique `point` uses it
  // for spheres that exceed the largest point.
  std::optional<SpriteDraw> rest;
  std::vector<ParticleRun> rest_runs;
};

class SpriteFrames final : public measure::Prepared {
 public:
  SpriteFrames(const Gpu& gpu, const Instance& instance, const measure::ParticleWork& work,
               const technique::Arrangement& arrangement, SpriteTechnique technique);

  void poison() override;
  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override;
  [[nodiscard]] core::Image image() override;
  [[nodiscard]] std::string kernel_hash() const override;

 private:
  struct Draws {
    vk::Pipeline draw;
    vk::Pipeline later;
    vk::Pipeline rest;  // null if there is no second draw
  };
  [[nodiscard]] Draws draws(bool counting) const;
  [[nodiscard]] DrawState draw_state(const SpriteDraw& draw, bool counting) const;
  [[nodiscard]] std::string_view pixel_stage(bool counting) const;
  void record(const vk::raii::CommandBuffer& commands, const Draws& draws, bool counting) const;
  void draw(const vk::raii::CommandBuffer& commands, const Draws& draws, bool counting) const;
  void draw_newly_visible(const vk::raii::CommandBuffer& commands, const Draws& draws,
                          bool counting) const;
  void bind_vertices(const vk::raii::CommandBuffer& commands, const Draws& draws) const;
  void bind();
  void draw_before(const measure::ParticleWork& work) const;
  void settle() const;
  void draw_run(const vk::raii::CommandBuffer& commands, bool instanced, ParticleRun run) const;
  void draw_again(const vk::raii::CommandBuffer& commands) const;
  // Draws every share[0]-th cell, and in each of these cells the first 1/share[1] of the particles.
  void draw_meshes(const vk::raii::CommandBuffer& commands,
                   const std::array<std::uint32_t, 2>& share) const;
  [[nodiscard]] std::vector<vk::DescriptorSetLayoutBinding> bindings() const;

  const Gpu& gpu_;
  const Instance& instance_;
  technique::ParticleOptions options_;
  scene::ColourKind colour_;
  SpriteTechnique technique_;
  Specialization constants_;
  ParticleData data_;
  ParticleTarget target_;
  Layout layout_;
  vk::raii::DescriptorPool pool_;
  vk::DescriptorSet set_;  // freed with the pool
  CellCulling culling_;
  std::optional<CellOcclusion> occlusion_;
  Draws draws_;
  Draws counting_draws_;  // null until work is to be counted
  Frames frames_;
};

// Arranges the scene and prepares a technique without a second draw.
[[nodiscard]] std::unique_ptr<measure::Prepared> prepare_sprites(const Gpu& gpu,
                                                                 const Instance& instance,
                                                                 const measure::ParticleWork& work,
                                                                 SpriteTechnique technique);

// The vertex stage of techniques that read a vertex buffer.
inline constexpr SpriteStage attribute_stage{vk::ShaderStageFlagBits::eVertex,
                                             "attributes.vert.spv", "attributes.vert.spv"};

}  // namespace triptych::vulkan_backend
