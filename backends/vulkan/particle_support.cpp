#include <fmt/format.h>

#include <algorithm>

#include "backends/vulkan/cell_culling.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/particle_target.hpp"
#include "backends/vulkan/support.hpp"
#include "technique/catalogue.hpp"
#include "technique/largest_image.hpp"
#include "technique/particles/option_reason.hpp"

namespace triptych::vulkan_backend {
namespace {

constexpr std::uint64_t sphere_bytes = 4 * sizeof(float);

std::uint64_t particle_bytes(const scene::ParticleSet& set) {
  return sphere_bytes + colour_bytes(set.colour) + sizeof(std::uint32_t);
}

std::optional<std::string> storage_reason(const Gpu& gpu, const scene::ParticleSet& set,
                                          const technique::Technique& drawn) {
  // the largest number of storage buffers that a technique binds
  constexpr std::uint32_t buffers = 12;
  const vk::PhysicalDeviceLimits& limits = gpu.properties.limits;
  if (limits.maxPerStageDescriptorStorageBuffers < buffers) {
    return fmt::format("needs {} storage buffers, but maxPerStageDescriptorStorageBuffers is {}",
                       buffers, limits.maxPerStageDescriptorStorageBuffers);
  }
  const std::uint64_t bytes = sphere_bytes * set.count();
  if (drawn.fetches_by_index && bytes > limits.maxStorageBufferRange) {
    return fmt::format(
        "{} particles need a storage buffer of {} bytes, but maxStorageBufferRange is {}",
        set.count(), bytes, limits.maxStorageBufferRange);
  }
  return std::nullopt;
}

// Returns the reason why the tessellator cannot generate polygons with this many corners; nullopt
// if it can. The corners are distributed over the four edges of the patch outline, so an edge gets
// at most a quarter of them, rounded up.
std::optional<std::string> corners_reason(const Gpu& gpu, int corners) {
  const std::uint32_t most = 4 * gpu.properties.limits.maxTessellationGenerationLevel;
  if (static_cast<std::uint32_t>(corners) <= most) return std::nullopt;
  return fmt::format(
      "corners={} is too large; maxTessellationGenerationLevel allows at most {} corners", corners,
      most);
}

}  // namespace

std::optional<std::string> feature_reason(const Gpu& gpu, Needs needs) {
  if (needs == Needs::nothing) return std::nullopt;
  if (!gpu.draws) return "the device has no graphics queue";
  if (gpu.features.fragmentStoresAndAtomics == VK_FALSE) {
    return "the device lacks fragmentStoresAndAtomics, which counting requires";
  }
  if (needs == Needs::geometry && gpu.features.geometryShader == VK_FALSE) {
    return "the device lacks geometryShader";
  }
  if (needs == Needs::tessellation && gpu.features.tessellationShader == VK_FALSE) {
    return "the device lacks tessellationShader";
  }
  if (needs == Needs::ray_query && !gpu.extensions.ray_query) {
    return "the device lacks VK_KHR_ray_query or an extension that it depends on; lavapipe "
           "has supported them since Mesa 25.0 (Debian 13)";
  }
  if (needs == Needs::ray_pipeline && !gpu.extensions.ray_pipeline) {
    return "the device lacks VK_KHR_ray_tracing_pipeline or an extension that it depends on; "
           "lavapipe has supported them since Mesa 25.0 (Debian 13)";
  }
  if (needs == Needs::mesh && !gpu.extensions.mesh_shader) {
    return "the device lacks VK_EXT_mesh_shader; lavapipe has supported it since Mesa 25.0 (Debian "
           "13)";
  }
  return std::nullopt;
}

std::optional<std::string> image_reason(const Gpu& gpu, int width, int height, Needs needs,
                                        std::uint64_t pixel_bytes) {
  const vk::PhysicalDeviceLimits& limits = gpu.properties.limits;
  if (needs != Needs::nothing) {
    const std::uint32_t limit =
        std::min({limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                  limits.maxImageDimension2D, std::ranges::min(limits.maxViewportDimensions)});
    if (static_cast<std::uint32_t>(std::max(width, height)) > limit) {
      return fmt::format("the image has {}x{} pixels, but the device can draw at most {}x{}", width,
                         height, limit, limit);
    }
  }
  const std::uint64_t bytes =
      pixel_bytes * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (bytes <= limits.maxStorageBufferRange) return std::nullopt;
  const std::uint64_t edge = technique::largest_square(limits.maxStorageBufferRange / pixel_bytes);
  return fmt::format(
      "an image of {}x{} pixels needs a storage buffer of {} bytes, but maxStorageBufferRange is "
      "{}; the largest square image is {}x{}",
      width, height, bytes, limits.maxStorageBufferRange, edge, edge);
}

std::optional<std::string> memory_reason(const Gpu& gpu, std::uint64_t needed) {
  if (!gpu.executes) return std::nullopt;  // the GPU is not present, and neither is its memory
  std::uint64_t largest = 0;
  for (std::uint32_t heap = 0; heap < gpu.memory.memoryHeapCount; ++heap) {
    const vk::MemoryHeap& each = gpu.memory.memoryHeaps[heap];
    if (each.flags & vk::MemoryHeapFlagBits::eDeviceLocal) largest = std::max(largest, each.size);
  }
  // If all heaps that are marked as device-local are empty, uses the other heaps.
  for (std::uint32_t heap = 0; heap < gpu.memory.memoryHeapCount && largest == 0; ++heap) {
    largest = gpu.memory.memoryHeaps[heap].size;
  }
  if (needed <= largest) return std::nullopt;
  return fmt::format("needs {} bytes of device memory, but the largest heap has {}", needed,
                     largest);
}

std::optional<std::string> particle_reason(const Gpu& gpu, const measure::ParticleWork& work,
                                           const std::string& technique, Needs needs) {
  const scene::ParticleScene& scene = work.scene;
  const scene::ParticleSet& set = *scene.particles;
  if (auto reason =
          technique::option_reason(technique, work.options, technique::SpriteRasterizer::api)) {
    return reason;
  }
  const technique::Technique& drawn = technique::technique(technique);
  if (drawn.uses_corners) {
    if (auto reason = corners_reason(gpu, work.options.corners)) return reason;
  }
  if (needs != Needs::nothing && gpu.features.vertexPipelineStoresAndAtomics == VK_FALSE) {
    return "the device lacks vertexPipelineStoresAndAtomics, which counting requires";
  }
  if (auto reason = ParticleTarget::format_reason(gpu)) return reason;
  if (work.options.culling != technique::Culling::none) {
    if (auto reason = culling_unsupported(gpu, drawn.instanced)) return reason;
  }
  if (auto reason = storage_reason(gpu, set, drawn)) return reason;
  constexpr std::uint64_t colour = 4 * sizeof(float);
  constexpr std::uint64_t depth = sizeof(float);
  const bool reads_depths = work.options.culling == technique::Culling::occlusion;
  std::uint64_t pixel_bytes = reads_depths ? depth : 0;
  const bool draws_sprites = drawn.method == technique::Method::sprites;
  if (!draws_sprites) pixel_bytes = depth + sizeof(std::uint32_t);  // plus the id of a particle
  if (auto reason = image_reason(gpu, scene.width, scene.height, needs, pixel_bytes)) {
    return reason;
  }
  constexpr std::uint64_t image_bytes = colour + 4 * sizeof(std::uint32_t);
  return memory_reason(gpu, particle_bytes(set) * set.count() +
                                image_bytes * static_cast<std::uint64_t>(scene.width) *
                                    static_cast<std::uint64_t>(scene.height));
}

}  // namespace triptych::vulkan_backend
