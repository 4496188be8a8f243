// Draws ray-aligned quads. Mesh shaders generate them for the cells (ranges of neighbouring
// particles) that task shaders do not cull (technique/particles/mesh.task.glsl, mesh.mesh.glsl).
#include <fmt/format.h>

#include "backends/vulkan/sprite_frames.hpp"
#include "backends/vulkan/techniques.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

// the sizes of a mesh work group, as in mesh.mesh.glsl
constexpr std::uint32_t mesh_vertices = 128;
constexpr std::uint32_t mesh_primitives = 64;
constexpr std::uint32_t mesh_invocations = 32;
constexpr std::uint32_t cells_per_task_group = 32;

SpriteDraw draw_meshes_with(SpriteStage task) {
  return {
      .stages = {task,
                 {vk::ShaderStageFlagBits::eMeshEXT, "mesh.mesh.spv", "mesh_counting.mesh.spv"}},
      .meshes = true};
}

constexpr SpriteStage draws_all{vk::ShaderStageFlagBits::eTaskEXT, "mesh_all.task.spv",
                                "mesh_all_counting.task.spv"};
constexpr SpriteStage draws_in_view{vk::ShaderStageFlagBits::eTaskEXT, "mesh_view.task.spv",
                                    "mesh_view_counting.task.spv"};
constexpr SpriteStage draws_visible_before{vk::ShaderStageFlagBits::eTaskEXT,
                                           "mesh_before.task.spv", "mesh_before_counting.task.spv"};
constexpr SpriteStage draws_newly_visible{vk::ShaderStageFlagBits::eTaskEXT, "mesh_now.task.spv",
                                          "mesh_now_counting.task.spv"};

SpriteTechnique mesh_technique(technique::Culling culling) {
  switch (culling) {
    case technique::Culling::none:
      return {.draw = draw_meshes_with(draws_all)};
    case technique::Culling::frustum:
      return {.draw = draw_meshes_with(draws_in_view)};
    case technique::Culling::occlusion:
      return {.draw = draw_meshes_with(draws_visible_before),
              .later = draw_meshes_with(draws_newly_visible)};
  }
  return {.draw = draw_meshes_with(draws_all)};
}

void check_mesh_limits(const Gpu& gpu, std::size_t cells) {
  const Extensions& has = gpu.extensions;
  if (has.mesh_vertices < mesh_vertices || has.mesh_primitives < mesh_primitives ||
      has.mesh_invocations < mesh_invocations) {
    throw core::NotSupported(fmt::format(
        "a mesh work group generates {} vertices and {} primitives with {} invocations, but the "
        "device's limits are {}, {} and {}",
        mesh_vertices, mesh_primitives, mesh_invocations, has.mesh_vertices, has.mesh_primitives,
        has.mesh_invocations));
  }
  const std::size_t groups = (cells + cells_per_task_group - 1) / cells_per_task_group;
  if (groups > has.task_groups) {
    throw core::NotSupported(
        fmt::format("{} cells (groups of neighbouring particles) need {} task groups, but "
                    "maxTaskWorkGroupCount is {}",
                    cells, groups, has.task_groups));
  }
}

}  // namespace

std::unique_ptr<measure::Prepared> prepare_mesh(const Gpu& gpu, const Instance& instance,
                                                const measure::ParticleWork& work) {
  const technique::Arrangement arrangement = technique::arrange(work.scene);
  check_mesh_limits(gpu, arrangement.cells.size());
  return std::make_unique<SpriteFrames>(gpu, instance, work, arrangement,
                                        mesh_technique(work.options.culling));
}

}  // namespace triptych::vulkan_backend
