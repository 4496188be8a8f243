#include "backends/vulkan/volume_parts.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <utility>

#include "backends/vulkan/volume_resources.hpp"
#include "technique/volume/long_rays.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::vulkan_backend {
namespace {

technique::MemoryLimit image_memory_limit(const Gpu& gpu, const technique::Layers& slices,
                                          scene::VoxelFormat format) try {
  const auto image = gpu.physical.getImageFormatProperties(
      texture_format(format), vk::ImageType::e3D, vk::ImageTiling::eOptimal,
      vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  const std::uint64_t deepest = slices.bytes * gpu.properties.limits.maxImageDimension3D;
  if (deepest < image.maxResourceSize)
    return {deepest, "the limit derived from maxImageDimension3D"};
  return {image.maxResourceSize, "maxResourceSize"};
} catch (const vk::FormatNotSupportedError&) {
  return {0, "the maximum size of an image in this format"};
}

// Returns the memory available for voxels under the device's limits, and the name of the decisive
// limit.
technique::MemoryLimit memory_limit(const Gpu& gpu, const measure::VolumeWork& work) {
  const scene::VoxelFormat format = work.scene.grid->format;
  if (is_packed(work)) {
    const std::uint64_t texels = gpu.properties.limits.maxTexelBufferElements;
    return {texels * technique::packed_texel_bytes(format),
            "the limit derived from maxTexelBufferElements"};
  }
  return image_memory_limit(gpu, technique::slice_layers(work.scene.grid->size, format), format);
}

}  // namespace

bool can_store_whole(const Gpu& gpu, const std::array<int, 3>& size, scene::VoxelFormat format) {
  const technique::Layers slices = technique::slice_layers(size, format);
  return slices.whole <= image_memory_limit(gpu, slices, format).bytes;
}

technique::Cut cut_of(const Gpu& gpu, std::string_view technique, const measure::VolumeWork& work) {
  const technique::Cut cut = technique::cut_into_parts(
      technique, work.scene, work.options, technique::layers_of(work.scene, work.options),
      technique::within_budget(memory_limit(gpu, work), work.options));
  if (cut.parts.empty()) return cut;
  if (technique::has_long_rays(work.scene)) {
    return {.parts = {}, .reason = std::string(technique::long_rays_in_parts)};
  }
  // The shader needs storage buffers for the output, the counters and the pauses (states that rays
  // keep from one part to the next). It needs two more for the bricks and the quadrature, unless it
  // reads these as texels.
  const std::uint32_t needed = is_packed(work) ? 3 : 5;
  const std::uint32_t most = gpu.properties.limits.maxPerStageDescriptorStorageBuffers;
  if (needed > most) {
    return {.parts = {},
            .reason = fmt::format("drawing a volume in parts needs {} storage buffers, but "
                                  "maxPerStageDescriptorStorageBuffers is {}",
                                  needed, most)};
  }
  return cut;
}

VolumeParts::VolumeParts(const Gpu& gpu, const measure::VolumeWork& work,
                         std::span<const technique::Part> parts, std::span<const std::int32_t> map,
                         std::vector<std::byte> parameters)
    : gpu_(gpu),
      grid_(work.scene.grid),
      layers_(technique::layers_of(work.scene, work.options)),
      passes_(technique::part_passes(parts, work.scene, work.options, map)),
      parameters_(std::move(parameters)),
      moved_(gpu.memory_ledger.moved(technique::moved_bytes(passes_, layers_))) {}

void VolumeParts::move(int n, const Buffer& parameters, const Image* image, const Buffer* cells) {
  const auto& [part, its, read] = passes_.at(static_cast<std::size_t>(n));
  std::memcpy(parameters_.data() + parameters_.size() - sizeof its, &its, sizeof its);
  upload(gpu_, parameters, parameters_);
  if (!read) return;
  if (image != nullptr) {
    const technique::Slices slices = technique::slices_of(part, *grid_);
    upload(gpu_, *image, slices.bytes, static_cast<std::uint32_t>(slices.count));
  } else {
    const std::size_t before = layers_.bytes * static_cast<std::size_t>(part.first_stored);
    upload(gpu_, *cells, layers_.bytes_of(part.stored_cells()),
           [&](std::size_t begin, std::span<std::byte> out) {
             technique::fill_packed_cells(*grid_, before + begin, out);
           });
  }
}

}  // namespace triptych::vulkan_backend
