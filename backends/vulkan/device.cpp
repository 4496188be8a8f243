#include "backends/vulkan/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "backends/vulkan/errors.hpp"
#include "backends/vulkan/features.hpp"
#include "backends/vulkan/filter_probe.hpp"
#include "backends/vulkan/particle_data.hpp"
#include "backends/vulkan/pipeline_code.hpp"
#include "backends/vulkan/support.hpp"
#include "backends/vulkan/techniques.hpp"
#include "backends/vulkan/volume_resources.hpp"
#include "core/error.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::vulkan_backend {
namespace {

template <class SuiteWork>
using Prepare = std::unique_ptr<measure::Prepared> (*)(const Gpu&, const Instance&,
                                                       const SuiteWork&);

struct Entry {
  std::string_view technique;
  // The alternatives have the same order as those of measure::Work.
  std::variant<Prepare<measure::VolumeWork>, Prepare<measure::ParticleWork>> prepare;
  Needs needs;
};
#define ENTRY(id, needs) Entry{#id, &prepare_##id, Needs::needs},
constexpr std::array entries{TRIPTYCH_VOLUME_TECHNIQUES(ENTRY) TRIPTYCH_PARTICLE_TECHNIQUES(ENTRY)};
#undef ENTRY

const Entry* find_entry(std::string_view technique) {
  const auto* found = std::ranges::find(entries, technique, &Entry::technique);
  return found != entries.end() ? found : nullptr;
}

// A texture filter whose error is below this fraction of the value range counts as exact, because
// it is as good as interpolation in single precision.
constexpr double exact_filter = 1e-5;

// Returns the filter error for each VoxelFormat; nullopt if the device cannot sample the format or
// only compiles.
std::array<std::optional<double>, 4> probe_filters(const Gpu& gpu) {
  if (!gpu.executes) return {};
  return {probe_filter(gpu, scene::VoxelFormat::u8), probe_filter(gpu, scene::VoxelFormat::u16),
          probe_filter(gpu, scene::VoxelFormat::f32), probe_filter(gpu, scene::VoxelFormat::f16)};
}

}  // namespace

Device::Device(std::unique_ptr<const Instance> instance, Candidate candidate)
    : instance_(std::move(instance)),
      info_(std::move(candidate.info)),
      gpu_(open_gpu(candidate.physical, instance_->labels(), info_.compiles_for.empty())),
      filter_errors_(probe_filters(gpu_)) {
  instance_->check_validation();
}

std::vector<measure::FeatureProbe> Device::feature_probes() {
  return vulkan_backend::feature_probes(gpu_);
}

std::optional<std::string> Device::unsupported(const measure::Work& work) const {
  return translated([&]() -> std::optional<std::string> {
    const Entry* entry = find_entry(work.technique);
    if (entry == nullptr)
      return fmt::format("technique '{}' is not implemented for Vulkan", work.technique);
    if (entry->prepare.index() != work.scene.index()) {
      return fmt::format("technique {} belongs to a different suite than the scene",
                         work.technique);
    }
    if (auto reason = feature_reason(gpu_, entry->needs)) return reason;
    if (const auto* volume = std::get_if<measure::VolumeWork>(&work.scene)) {
      return volume_reason(gpu_, *volume, work.technique, entry->needs);
    }
    return particle_reason(gpu_, std::get<measure::ParticleWork>(work.scene), work.technique,
                           entry->needs);
  });
}

std::optional<double> Device::hardware_error(scene::VoxelFormat format) const {
  return filter_errors_.at(static_cast<std::size_t>(format));
}

// Prefers the hardware sampler if its filter is exact, because on all devices with filtering
// hardware, such a filter is faster than eight fetches and their arithmetic. Of the formats with an
// exact filter, R32F is the fastest on CPU devices, and no slower than others elsewhere as long as
// the volume fits into the caches. A volume that the device cannot store as one image is drawn in
// parts, which is impossible with hardware samplers.
measure::VolumePath Device::default_path(const measure::VolumeKind& volume) const {
  const scene::VoxelFormat native = volume.native;
  if (gpu_.is_cpu() && volume.may_be_packed() &&
      technique::packs_by_default(volume.size, native, volume.filter_suffices,
                                  gpu_.properties.limits.maxTexelBufferElements)) {
    return {.voxel = native, .sampler = technique::Sampler::packed};
  }
  for (const scene::VoxelFormat format : {scene::VoxelFormat::f32, native}) {
    if (!can_store_whole(gpu_, volume.size, format)) continue;
    if (hardware_error(format).value_or(1) < exact_filter) {
      return {.voxel = format, .sampler = technique::Sampler::hardware};
    }
  }
  return {.voxel = native, .sampler = technique::Sampler::manual};
}

double Device::filter_weight_error(const measure::VolumePath& path) const {
  if (path.sampler != technique::Sampler::hardware) return 0;
  const std::optional<double> error = hardware_error(path.voxel);
  // Returns at most the allowed error, because a faulty filter must not widen the error bound of
  // images.
  if (error) return std::min(*error, allowed_filter_error(gpu_, path.voxel));
  throw core::NotSupported(fmt::format("the device cannot filter images of format {} linearly",
                                       vk::to_string(texture_format(path.voxel))));
}

std::optional<measure::Rasterizer> Device::rasterizer() const {
  return measure::Rasterizer{
      .sub_pixel_bits = static_cast<int>(gpu_.properties.limits.subPixelPrecisionBits),
      .point_margin = static_cast<double>(point_margin(gpu_)),
      .largest_point = static_cast<double>(largest_point(gpu_))};
}

std::unique_ptr<measure::Prepared> Device::prepare(const measure::Work& work) {
  const auto reason = unsupported(work);
  const Entry* entry = find_entry(work.technique);
  if (reason || entry == nullptr) throw core::NotSupported(reason.value_or(work.technique));
  return translated([&] {
    return std::visit(
        [&]<class SuiteWork>(const SuiteWork& scene) {
          return std::get<Prepare<SuiteWork>>(entry->prepare)(gpu_, *instance_, scene);
        },
        work.scene);
  });
}

// Prepares the work, because that builds all pipelines of a timed frame, and returns the code that
// the driver reports for these pipelines. Draws nothing.
measure::Compiled Device::compile(const measure::Work& work) {
  if (!gpu_.reports_code) {
    throw core::NotSupported(
        "this driver lacks VK_KHR_pipeline_executable_properties, so it reports nothing about the "
        "code that it generates");
  }
  gpu_.pipelines->start_capture();
  try {
    static_cast<void>(prepare(work));
  } catch (...) {
    static_cast<void>(gpu_.pipelines->end_capture());
    throw;
  }
  return translated([&] { return code_of(gpu_, gpu_.pipelines->end_capture()); });
}

}  // namespace triptych::vulkan_backend
