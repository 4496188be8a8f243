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
  if (!can_sample(gpu, format)) return fmt::format("cannot sample images of format {}", name);
  if (work.options.sampler == technique::Sampler::hardware && !can_filter(gpu, format)) {
    return fmt::format("cannot filter images of format {} linearly", name);
  }
  return std::nullopt;
}

std::optional<std::string> texel_reason(const Gpu& gpu, const measure::VolumeWork& work,
                                        const technique::RaycastBuffers& buffers) {
  return technique::packed_reason(
      *work.scene.grid, buffers,
      {.texels = gpu.properties.limits.maxTexelBufferElements, .name = "maxTexelBufferElements"});
}

std::optional<std::string> volume_size_reason(const Gpu& gpu, const scene::VoxelGrid& grid) {
  const std::uint32_t limit = gpu.properties.limits.maxImageDimension3D;
  const int longest = std::ranges::max(grid.size);
  if (static_cast<std::uint32_t>(longest) > limit) {
    return fmt::format("a volume of {}x{}x{} voxels exceeds maxImageDimension3D = {}", grid.size[0],
                       grid.size[1], grid.size[2], limit);
  }
  const auto format = gpu.physical.getImageFormatProperties(
      texture_format(grid.format), vk::ImageType::e3D, vk::ImageTiling::eOptimal,
      vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  const std::uint64_t bytes = grid.voxel_count() * scene::bytes_of(grid.format);
  if (bytes > format.maxResourceSize) {
    return fmt::format("a volume of {} bytes exceeds maxResourceSize = {}", bytes,
                       format.maxResourceSize);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> volume_reason(const Gpu& gpu, const measure::VolumeWork& work,
                                         std::string_view technique, Needs needs) {
  const scene::VolumeScene& scene = work.scene;
  if (auto reason = technique::raycast_reason(technique, scene, work.options)) return reason;
  if (work.options.precision == technique::Precision::fp64 && !gpu.features.shaderFloat64) {
    return "precision fp64 needs shaderFloat64, which the device lacks";
  }
  const technique::RaycastBuffers buffers = technique::raycast_buffers(scene, work.options);
  if (is_packed(work)) {
    if (auto reason = texel_reason(gpu, work, buffers)) return reason;
  } else {
    if (auto reason = format_reason(gpu, work)) return reason;
    if (auto reason = volume_size_reason(gpu, *scene.grid)) return reason;
  }
  constexpr std::uint64_t pixel_bytes = technique::raycast_counter_stride * sizeof(std::uint32_t);
  if (auto reason = picture_reason(gpu, scene.width, scene.height, needs, pixel_bytes)) {
    return reason;
  }
  if (auto reason = technique::buffer_reason(buffers, gpu.properties.limits.maxStorageBufferRange,
                                             "maxStorageBufferRange")) {
    return reason;
  }
  const std::uint64_t volume =
      is_packed(work) ? technique::packed_bytes(scene.grid->size, scene.grid->format)
                      : scene.grid->voxel_count() * scene::bytes_of(scene.grid->format);
  return memory_reason(gpu, volume + buffers.all());
}

}  // namespace triptych::vulkan_backend
