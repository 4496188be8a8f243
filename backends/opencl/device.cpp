#include "backends/opencl/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "backends/opencl/features.hpp"
#include "backends/opencl/filter_probe.hpp"
#include "backends/opencl/kernel_code.hpp"
#include "backends/opencl/particle_limits.hpp"
#include "backends/opencl/programs.hpp"
#include "backends/opencl/techniques.hpp"
#include "backends/opencl/volume_data.hpp"
#include "backends/opencl/volume_parts.hpp"
#include "core/error.hpp"
#include "technique/largest_image.hpp"
#include "technique/volume/filter_bound.hpp"
#include "technique/volume/raycast_buffers.hpp"

namespace triptych::opencl_backend {
namespace {

using technique::Sampler;

#define ENTRY(id, needs) {#id, prepare_##id},
const std::map<std::string_view, decltype(&prepare_raycast)> volume_techniques{
    TRIPTYCH_VOLUME_TECHNIQUES(ENTRY)};
const std::map<std::string_view, decltype(&prepare_tiles)> particle_techniques{
    TRIPTYCH_PARTICLE_TECHNIQUES(ENTRY)};
#undef ENTRY

Session open_session(const Found& found) {
  return checked([&] {
    const cl::Context context(found.device);
    // Kernels process samples in batches of 32 only on PoCL's CPU devices, because only PoCL's
    // compiler vectorises the loops inside a work item. Other compilers vectorise across work
    // items.
    const bool vectorises_loops = found.info.driver == "pocl" && !found.info.cpu_features.empty();
    return Session{.device = found.device,
                   .context = context,
                   .queue = {cl::CommandQueue(context, found.device, CL_QUEUE_PROFILING_ENABLE),
                             found.info.compiles_for.empty()},
                   .batch = vectorises_loops ? 32 : 1};
  });
}

class Device final : public measure::Device, public measure::FeatureProber {
 public:
  explicit Device(Found found)
      : info_(std::move(found.info)),
        session_(open_session({found.device, info_})),
        is_gpu_((checked([&] { return found.device.getInfo<CL_DEVICE_TYPE>(); }) &
                 CL_DEVICE_TYPE_GPU) != 0),
        has_doubles_(checked([&] { return found.device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>(); }) !=
                     0) {}

  [[nodiscard]] const record::Device& info() const override { return info_; }
  [[nodiscard]] std::optional<std::string> unsupported(const measure::Work& work) const override;
  [[nodiscard]] measure::VolumePath default_path(const measure::VolumeKind& volume) const override;
  [[nodiscard]] double filter_weight_error(const measure::VolumePath& path) const override;
  [[nodiscard]] record::Counts memory() const override { return session_.memory_ledger.counts(); }
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare(const measure::Work& work) override;
  [[nodiscard]] measure::Compiled compile(const measure::Work& work) override;
  [[nodiscard]] std::vector<measure::FeatureProbe> feature_probes() override {
    return opencl_backend::feature_probes(session_, programs_);
  }

 private:
  // Returns the sampler error that the probe measured.
  [[nodiscard]] double sampler_error(scene::VoxelFormat format) const;
  [[nodiscard]] std::optional<std::string> half_format_reason(scene::VoxelFormat format) const;
  [[nodiscard]] std::optional<std::string> sampler_image_reason(const scene::VoxelGrid& grid) const;
  [[nodiscard]] std::optional<std::string> size_reason(std::string_view technique,
                                                       const measure::VolumeWork& work) const;

  record::Device info_;
  Session session_;
  bool is_gpu_;
  bool has_doubles_;
  mutable Programs programs_{session_};
  mutable std::map<scene::VoxelFormat, double> filter_errors_;
  VolumeCache volumes_;
};

// PoCL 3.1 claims to support images of half floats, but cannot read them without cl_khr_fp16.
std::optional<std::string> Device::half_format_reason(scene::VoxelFormat format) const {
  if (format != scene::VoxelFormat::f16 || !session_.queue.executes()) return std::nullopt;
  const double error = sampler_error(format);
  const double allowed = technique::allowed_filter_error(technique::least_weight_bits, format);
  if (error <= allowed) return std::nullopt;
  return fmt::format(
      "sampler=hardware: the device reads half-float images with an error of {:.3g}, but the "
      "tolerance is {:.3g}",
      error, allowed);
}

// Returns the reason why the hardware sampler cannot be used for the grid.
std::optional<std::string> Device::sampler_image_reason(const scene::VoxelGrid& grid) const {
  return checked([&]() -> std::optional<std::string> {
    const cl::Device& device = session_.device;
    if (device.getInfo<CL_DEVICE_IMAGE_SUPPORT>() == CL_FALSE) {
      return "sampler=hardware: CL_DEVICE_IMAGE_SUPPORT is false";
    }
    if (!image_format(session_, grid.format)) {
      return fmt::format("sampler=hardware: the device has no 3D image format for voxel={}",
                         scene::name_of(grid.format));
    }
    if (auto reason = half_format_reason(grid.format)) return reason;
    const std::array<std::size_t, 3> limits{device.getInfo<CL_DEVICE_IMAGE3D_MAX_WIDTH>(),
                                            device.getInfo<CL_DEVICE_IMAGE3D_MAX_HEIGHT>(),
                                            device.getInfo<CL_DEVICE_IMAGE3D_MAX_DEPTH>()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (static_cast<std::size_t>(grid.size.at(axis)) > limits.at(axis)) {
        return fmt::format(
            "the volume has {}x{}x{} voxels, but the device supports 3D images of at most {}x{}x{}",
            grid.size[0], grid.size[1], grid.size[2], limits[0], limits[1], limits[2]);
      }
    }
    return std::nullopt;
  });
}

// Returns the reason why one of the buffers does not fit into memory.
std::optional<std::string> Device::size_reason(std::string_view technique,
                                               const measure::VolumeWork& work) const {
  const technique::Cut cut = cut_of(session_, technique, work);
  if (cut.reason) return cut.reason;
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(work.scene.width) * static_cast<std::uint64_t>(work.scene.height);
  if (pixels * technique::raycast_counter_stride > most_indices) {
    constexpr std::uint64_t most_pixels = most_indices / technique::raycast_counter_stride;
    return fmt::format(
        "the image has {} pixels, but the kernel can index at most {}; the largest square image is "
        "{}x{}",
        pixels, most_pixels, technique::largest_square(most_pixels),
        technique::largest_square(most_pixels));
  }
  technique::RaycastBuffers buffers = technique::raycast_buffers(work.scene, work.options);
  if (!cut.parts.empty()) buffers.pauses = technique::pauses_bytes(work.scene, work.options);
  const auto most =
      checked([&] { return session_.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); });
  if (auto reason = technique::buffer_reason(buffers, most, "CL_DEVICE_MAX_MEM_ALLOC_SIZE")) {
    return reason;
  }
  const std::uint64_t all =
      bordered_layers(*work.scene.grid).largest_part_bytes(cut.parts) + buffers.all();
  const auto total = checked([&] { return session_.device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>(); });
  if (all > total) {
    return fmt::format("needs {} bytes of device memory, but CL_DEVICE_GLOBAL_MEM_SIZE is {}", all,
                       total);
  }
  return std::nullopt;
}

std::optional<std::string> Device::unsupported(const measure::Work& work) const {
  if (!volume_techniques.contains(work.technique) &&
      !particle_techniques.contains(work.technique)) {
    return fmt::format("technique '{}' is not implemented for OpenCL", work.technique);
  }
  const auto* particles = std::get_if<measure::ParticleWork>(&work.scene);
  const auto* volume = std::get_if<measure::VolumeWork>(&work.scene);
  const bool draws_particles = particle_techniques.contains(work.technique);
  if (draws_particles ? particles == nullptr : volume == nullptr) {
    return fmt::format("technique '{}' draws {}, but the scene contains none", work.technique,
                       draws_particles ? "particles" : "volumes");
  }
  if (particles != nullptr) return particles_unsupported(session_, work.technique, *particles);
  if (auto reason = technique::raycast_reason(work.technique, volume->scene, volume->options)) {
    return reason;
  }
  if (volume->options.precision == technique::Precision::fp64 && !has_doubles_) {
    return "precision=fp64 requires cl_khr_fp64, which the device lacks";
  }
  if (volume->options.sampler == Sampler::packed) {
    return "sampler=packed requires texel buffers, which OpenCL C lacks; use sampler=manual, which "
           "in OpenCL reads two neighbouring voxels at once";
  }
  if (volume->options.sampler == Sampler::hardware) {
    if (auto reason = sampler_image_reason(*volume->scene.grid)) return reason;
  }
  return size_reason(work.technique, *volume);
}

// Unless the hardware sampler is exact, voxels are read from a buffer and interpolated in the
// kernel. On PoCL 3.1, this is also nine times as fast as the sampler (speed_of_light: 405 versus
// 44 million samples per second on two cores). Voxels are stored in the volume's native format:
// PoCL reads u8, u16 and f32 equally fast from the caches (409, 413 and 446 million samples per
// second at 128³), and the smaller formats let larger volumes fit into the caches.
measure::VolumePath Device::default_path(const measure::VolumeKind& volume) const {
  const scene::VoxelFormat native = volume.native;
  const measure::VolumePath hardware{native, Sampler::hardware};
  constexpr double exact = 1e-5;
  if (is_gpu_ && image_format(session_, native) && sampler_error(native) < exact) {
    return hardware;
  }
  return {native, Sampler::manual};
}

double Device::filter_weight_error(const measure::VolumePath& path) const {
  if (path.sampler != Sampler::hardware) return 0;
  // Returns at most the allowed error, because a faulty filter must not widen the error bound of
  // images.
  return std::min(sampler_error(path.voxel),
                  technique::allowed_filter_error(technique::least_weight_bits, path.voxel));
}

double Device::sampler_error(scene::VoxelFormat format) const {
  // A device that only compiles cannot sample anything, so this returns the worst possible error.
  if (!session_.queue.executes()) return 1;
  const auto known = filter_errors_.find(format);
  if (known != filter_errors_.end()) return known->second;
  return filter_errors_.emplace(format, probe_filter(session_, programs_, format)).first->second;
}

std::unique_ptr<measure::Prepared> Device::prepare(const measure::Work& work) {
  if (const auto reason = unsupported(work)) throw core::NotSupported(*reason);
  if (const auto* particles = std::get_if<measure::ParticleWork>(&work.scene)) {
    // Frees the cached volume (for example, the volume that was used to calibrate statistics),
    // because its memory must not be attributed to this frame.
    volumes_ = {};
    return particle_techniques.at(work.technique)(session_, programs_, *particles);
  }
  const auto& volume = std::get<measure::VolumeWork>(work.scene);
  return volume_techniques.at(work.technique)(session_, programs_, volumes_, volume);
}

measure::Compiled Device::compile(const measure::Work& work) {
  programs_.start_capture();
  try {
    static_cast<void>(prepare(work));
  } catch (...) {
    static_cast<void>(programs_.end_capture());
    throw;
  }
  return checked([&] { return code_of(session_, programs_.end_capture()); });
}

}  // namespace

std::unique_ptr<measure::Device> open_device(Found found) {
  return std::make_unique<Device>(std::move(found));
}

}  // namespace triptych::opencl_backend
