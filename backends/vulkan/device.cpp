#include "backends/vulkan/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/filter_probe.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "core/error.hpp"

namespace triptych::vulkan_backend {
namespace {

using Prepare = std::unique_ptr<measure::Prepared> (*)(const Gpu&, const Instance&,
                                                       const measure::VolumeWork&);

struct Entry {
  std::string_view technique;
  Prepare prepare;
  bool draws;
};
constexpr std::array<Entry, 3> entries{{
    {"raycast", &prepare_raycast, false},
    {"raycast_fragment", &prepare_raycast_fragment, true},
    {"speed_of_light", &prepare_speed_of_light, false},
}};

const Entry* find_entry(std::string_view technique) {
  const auto* found = std::ranges::find(entries, technique, &Entry::technique);
  return found != entries.end() ? found : nullptr;
}

// Below this a device's filter is as good as interpolation in single precision.
constexpr double exact_filter = 1e-5;

std::optional<std::string> format_reason(const Gpu& gpu, const measure::VolumeWork& work) {
  const scene::VoxelFormat format = work.scene.grid->format;
  const std::string name = vk::to_string(texture_format(format));
  if (!can_sample(gpu, format)) return fmt::format("cannot sample images of format {}", name);
  if (work.options.sampler == technique::Sampler::hardware && !can_filter(gpu, format)) {
    return fmt::format("cannot filter images of format {} linearly", name);
  }
  return std::nullopt;
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

std::optional<std::string> picture_reason(const Gpu& gpu, const scene::VolumeScene& scene,
                                          bool draws) {
  const vk::PhysicalDeviceLimits& limits = gpu.properties.limits;
  if (draws) {
    const std::uint32_t limit =
        std::min({limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                  limits.maxImageDimension2D, std::ranges::min(limits.maxViewportDimensions)});
    if (static_cast<std::uint32_t>(std::max(scene.width, scene.height)) <= limit) {
      return std::nullopt;
    }
    return fmt::format("a viewport of {}x{} exceeds the largest frame buffer of {}", scene.width,
                       scene.height, limit);
  }
  const std::uint64_t bytes = 4 * sizeof(float) * static_cast<std::uint64_t>(scene.width) *
                              static_cast<std::uint64_t>(scene.height);
  if (bytes > limits.maxStorageBufferRange) {
    return fmt::format("a viewport of {}x{} needs {} bytes; maxStorageBufferRange = {}",
                       scene.width, scene.height, bytes, limits.maxStorageBufferRange);
  }
  return std::nullopt;
}

std::optional<std::string> memory_reason(const Gpu& gpu, const scene::VolumeScene& scene) {
  std::uint64_t largest = 0;
  for (std::uint32_t heap = 0; heap < gpu.memory.memoryHeapCount; ++heap) {
    const vk::MemoryHeap& each = gpu.memory.memoryHeaps[heap];
    if (each.flags & vk::MemoryHeapFlagBits::eDeviceLocal) largest = std::max(largest, each.size);
  }
  const std::uint64_t needed = scene.grid->voxel_count() * scene::bytes_of(scene.grid->format) +
                               4 * sizeof(float) * static_cast<std::uint64_t>(scene.width) *
                                   static_cast<std::uint64_t>(scene.height);
  if (needed <= largest) return std::nullopt;
  return fmt::format("needs {} bytes of device memory; the largest heap has {}", needed, largest);
}

}  // namespace

Device::Device(std::unique_ptr<const Instance> instance, Candidate candidate)
    : instance_(std::move(instance)),
      info_(std::move(candidate.info)),
      gpu_(open_gpu(candidate.physical)),
      filter_errors_{probe_filter(gpu_, scene::VoxelFormat::u8),
                     probe_filter(gpu_, scene::VoxelFormat::u16),
                     probe_filter(gpu_, scene::VoxelFormat::f32)} {
  instance_->check_validation();
}

std::optional<std::string> Device::unsupported(const measure::Work& work) const {
  return translated([&]() -> std::optional<std::string> {
    const Entry* entry = find_entry(work.technique);
    if (entry == nullptr) return fmt::format("Vulkan has no technique {}", work.technique);
    if (entry->draws && !gpu_.draws) return "the device has no queue that draws";
    if (entry->draws && gpu_.features.fragmentStoresAndAtomics == VK_FALSE) {
      return "the device lacks fragmentStoresAndAtomics, which counting needs";
    }
    const auto& volume = std::get<measure::VolumeWork>(work.scene);
    if (auto reason = format_reason(gpu_, volume)) return reason;
    if (auto reason = volume_size_reason(gpu_, *volume.scene.grid)) return reason;
    if (auto reason = picture_reason(gpu_, volume.scene, entry->draws)) return reason;
    return memory_reason(gpu_, volume.scene);
  });
}

std::optional<double> Device::hardware_error(scene::VoxelFormat format) const {
  return filter_errors_.at(static_cast<std::size_t>(format));
}

// A filter that is exact beats eight fetches and their arithmetic everywhere; among exact ones R32F
// is the fastest on CPU devices, and no slower elsewhere while it fits the caches.
measure::VolumePath Device::default_path(scene::VoxelFormat native) const {
  for (const scene::VoxelFormat format : {scene::VoxelFormat::f32, native}) {
    if (hardware_error(format).value_or(1) < exact_filter) {
      return {.voxel = format, .sampler = technique::Sampler::hardware};
    }
  }
  return {.voxel = native, .sampler = technique::Sampler::manual};
}

double Device::filter_weight_error(const measure::VolumePath& path) const {
  if (path.sampler == technique::Sampler::manual) return 0;
  const std::optional<double> error = hardware_error(path.voxel);
  if (error) return *error;
  throw core::NotSupported(fmt::format("cannot filter images of format {} linearly",
                                       vk::to_string(texture_format(path.voxel))));
}

std::unique_ptr<measure::Prepared> Device::prepare(const measure::Work& work) {
  const auto reason = unsupported(work);
  const Entry* entry = find_entry(work.technique);
  if (reason || entry == nullptr) throw core::NotSupported(reason.value_or(work.technique));
  return translated(
      [&] { return entry->prepare(gpu_, *instance_, std::get<measure::VolumeWork>(work.scene)); });
}

}  // namespace triptych::vulkan_backend
