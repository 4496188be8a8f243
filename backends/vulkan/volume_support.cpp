#include <fmt/format.h>

#include <algorithm>

#include "backends/vulkan/filter_probe.hpp"
#include "backends/vulkan/support.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "technique/volume/packed_cells.hpp"
#include "technique/volume/raycast_buffers.hpp"

namespace triptych::vulkan_backend {
namespace {

std::optional<std::string> format_reason(const Gpu& gpu, const measure::VolumeWork& work) {
  const scene::VoxelFormat format = work.scene.grid->format;
  const std::string name = vk::to_string(texture_format(format));
  if (!can_sample(gpu, format))
    return fmt::format("the device cannot sample images of format {}", name);
  if (work.options.sampler == technique::Sampler::hardware && !can_filter(gpu, format)) {
    return fmt::format("the device cannot filter images of format {} linearly", name);
  }
  return std::nullopt;
}

std::optional<std::string> volume_size_reason(const Gpu& gpu, const scene::VoxelGrid& grid,
                                              bool in_parts) {
  const std::uint32_t limit = gpu.properties.limits.maxImageDimension3D;
  const auto [nx, ny, nz] = grid.size;
  const int longest = in_parts ? std::max(nx, ny) : std::max({nx, ny, nz});
  if (static_cast<std::uint32_t>(longest) <= limit) return std::nullopt;
  return fmt::format("the volume has {}x{}x{} voxels, but maxImageDimension3D is {}", nx, ny, nz,
                     limit);
}

// Returns the reason why the volume fits neither as a whole nor in parts.
std::optional<std::string> voxels_reason(const Gpu& gpu, const measure::VolumeWork& work,
                                         const technique::RaycastBuffers& buffers,
                                         const technique::Cut& cut) {
  const scene::VoxelGrid& grid = *work.scene.grid;
  const bool in_parts = !cut.parts.empty();
  std::optional<std::string> reason;
  if (is_packed(work)) {
    reason = technique::packed_reason(
        in_parts ? 0 : technique::packed_texels(grid.size, grid.format), buffers,
        {.texels = gpu.properties.limits.maxTexelBufferElements, .name = "maxTexelBufferElements"});
  } else {
    reason = format_reason(gpu, work);
    if (!reason) reason = volume_size_reason(gpu, grid, in_parts);
  }
  return reason ? reason : cut.reason;
}

}  // namespace

std::optional<std::string> volume_reason(const Gpu& gpu, const measure::VolumeWork& work,
                                         std::string_view technique, Needs needs) {
  const scene::VolumeScene& scene = work.scene;
  if (auto reason = technique::raycast_reason(technique, scene, work.options)) return reason;
  if (work.options.precision == technique::Precision::fp64 && !gpu.features.shaderFloat64) {
    return "precision=fp64 needs shaderFloat64, which the device lacks";
  }
  technique::RaycastBuffers buffers = technique::raycast_buffers(scene, work.options);
  const technique::Cut cut = cut_of(gpu, technique, work);
  if (!cut.parts.empty()) buffers.pauses = technique::pauses_bytes(scene, work.options);
  if (auto reason = voxels_reason(gpu, work, buffers, cut)) return reason;
  constexpr std::uint64_t pixel_bytes = technique::raycast_counter_stride * sizeof(std::uint32_t);
  if (auto reason = image_reason(gpu, scene.width, scene.height, needs, pixel_bytes)) {
    return reason;
  }
  if (auto reason = technique::buffer_reason(buffers, gpu.properties.limits.maxStorageBufferRange,
                                             "maxStorageBufferRange")) {
    return reason;
  }
  return memory_reason(
      gpu,
      technique::layers_of(work.scene, work.options).largest_part_bytes(cut.parts) + buffers.all());
}

}  // namespace triptych::vulkan_backend
