#include "backends/gl/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <variant>

#include "backends/gl/compute_pass.hpp"
#include "backends/gl/device_info.hpp"
#include "backends/gl/features.hpp"
#include "backends/gl/filter_probe.hpp"
#include "backends/gl/large_points.hpp"
#include "backends/gl/program_code.hpp"
#include "backends/gl/techniques.hpp"
#include "backends/gl/volume_parts.hpp"
#include "backends/gl/volume_prepared.hpp"
#include "core/error.hpp"
#include "technique/particles/option_reason.hpp"
#include "technique/volume/filter_bound.hpp"
#include "technique/volume/packed_cells.hpp"

namespace triptych::gl_backend {
namespace {

// A sampler whose error is below this fraction of the value range is as good as interpolation in
// the shader, whose rounding errors are about 1e-6.
constexpr double exact_filter = 1e-5;

struct Entry {
  std::string_view id;
  std::variant<VolumeTechnique, ParticleTechnique> technique;
};

const Entry* find(std::string_view technique) {
#define ENTRY(id, needs) Entry{#id, id()},
  static const std::array entries{TRIPTYCH_VOLUME_TECHNIQUES(ENTRY)
                                      TRIPTYCH_PARTICLE_TECHNIQUES(ENTRY)};
#undef ENTRY
  for (const Entry& entry : entries) {
    if (entry.id == technique) return &entry;
  }
  return nullptr;
}

class GlDevice final : public measure::Device, public measure::FeatureProber {
 public:
  GlDevice(record::Device info, std::unique_ptr<Context> context)
      : info_(std::move(info)),
        context_(std::move(context)),
        stamps_(is_software(info_) ? Stamps::finished : Stamps::in_stream) {
    const Current current(*context_);
    const double margin = point_margin(context_->gl());
    rasterizer_ = {context_->gl().sub_pixel_bits(), margin, largest_point(context_->gl()) - margin};
    most_texels_ = static_cast<std::uint64_t>(context_->gl().limit(GL_MAX_TEXTURE_BUFFER_SIZE));
    if (!info_.compiles_for.empty()) {
      context_->set_compile_only();
      return;
    }
    if (ComputePass::unsupported(context_->gl(), 1, 1)) return;
    for (std::size_t i = 0; i < filter_error_.size(); ++i) {
      filter_error_[i] = probe_filter(context_->gl(), static_cast<scene::VoxelFormat>(i));
    }
  }

  [[nodiscard]] const record::Device& info() const override { return info_; }

  [[nodiscard]] std::optional<std::string> unsupported(const measure::Work& work) const override {
    const Entry* entry = find(work.technique);
    if (entry == nullptr)
      return fmt::format("technique '{}' is not implemented for OpenGL", work.technique);
    if (is_software(info_) && std::getenv("LP_PERF") != nullptr) {
      return "the environment variable LP_PERF is set, which makes the driver skip work; unset it";
    }
    const Current current(*context_);
    const Api& gl = context_->gl();
    const auto* volume = std::get_if<measure::VolumeWork>(&work.scene);
    const auto* particles = std::get_if<measure::ParticleWork>(&work.scene);
    if (const auto* raycaster = std::get_if<VolumeTechnique>(&entry->technique)) {
      if (volume == nullptr)
        return fmt::format("technique {} draws only volumes, but the scene contains particles",
                           work.technique);
      auto reason = technique::raycast_reason(work.technique, volume->scene, volume->options);
      if (!reason) reason = volume_unsupported(gl, work.technique, *volume);
      if (!reason) reason = raycaster->unsupported(gl, *volume);
      return reason;
    }
    if (particles == nullptr)
      return fmt::format("technique {} draws only particles, but the scene contains a volume",
                         work.technique);
    auto reason = technique::option_reason(work.technique, particles->options,
                                           technique::SpriteRasterizer::api);
    if (!reason) {
      reason = std::get<ParticleTechnique>(entry->technique).unsupported(gl, *particles);
    }
    return reason;
  }

  [[nodiscard]] measure::VolumePath default_path(const measure::VolumeKind& volume) const override {
    if (context_->computes_on_cpu() && volume.may_be_packed() &&
        technique::packs_by_default(volume.size, volume.native, volume.filter_suffices,
                                    most_texels_)) {
      return {volume.native, technique::Sampler::packed};
    }
    const measure::VolumePath hardware{scene::VoxelFormat::f32, technique::Sampler::hardware};
    if (filter_weight_error(hardware) < exact_filter &&
        can_store_whole(volume.size, hardware.voxel)) {
      return hardware;
    }
    return {volume.native, technique::Sampler::manual};
  }

  [[nodiscard]] double filter_weight_error(const measure::VolumePath& path) const override {
    if (path.sampler != technique::Sampler::hardware) return 0;
    // Returns at most the allowed error, because a faulty filter must not widen the error bound of
    // images.
    return std::min(filter_error_.at(static_cast<std::size_t>(path.voxel)),
                    technique::allowed_filter_error(technique::least_weight_bits, path.voxel));
  }

  [[nodiscard]] std::optional<measure::Rasterizer> rasterizer() const override {
    return rasterizer_;
  }

  [[nodiscard]] record::Counts memory() const override {
    return context_->gl().memory_ledger.counts();
  }

  [[nodiscard]] std::vector<measure::FeatureProbe> feature_probes() override {
    return gl_backend::feature_probes(*context_);
  }

  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare(const measure::Work& work) override {
    if (const auto reason = unsupported(work)) throw core::NotSupported(*reason);
    const Current current(*context_);
    return prepare_current(work);
  }

  // Prepares the work, because that links the programs of a timed frame and makes the driver report
  // their code. Shader variants that a driver compiles only at the first draw are not included.
  [[nodiscard]] measure::Compiled compile(const measure::Work& work) override {
    const Current current(*context_);
    const Api& gl = context_->gl();
    if (!gl.can_keep_reports()) {
      throw core::NotSupported(
          "the driver does not report the code that it generates, because the context lacks "
          "KHR_debug or is not a debug context; set TRIPTYCH_GL_DEBUG=1 to request a debug "
          "context");
    }
    gl.keep_reports();
    try {
      static_cast<void>(prepare_current(work));
    } catch (...) {
      static_cast<void>(gl.take_reports());
      throw;
    }
    return code_of(gl.take_reports());
  }

 private:
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare_current(const measure::Work& work) {
    const Entry& entry = *find(work.technique);
    if (const auto* raycaster = std::get_if<VolumeTechnique>(&entry.technique)) {
      return raycaster->prepare(*context_, stamps_, std::get<measure::VolumeWork>(work.scene));
    }
    return make_prepared(*context_, stamps_,
                         std::get<ParticleTechnique>(entry.technique)
                             .make(context_->gl(), std::get<measure::ParticleWork>(work.scene)));
  }

  // Returns whether the volume fits into one texture. Larger volumes are drawn in parts, which is
  // impossible with hardware samplers.
  [[nodiscard]] bool can_store_whole(const std::array<int, 3>& size,
                                     scene::VoxelFormat format) const {
    const Current current(*context_);
    return gl_backend::can_store_whole(context_->gl(), size, format);
  }

  record::Device info_;
  std::unique_ptr<Context> context_;
  Stamps stamps_;
  measure::Rasterizer rasterizer_;
  std::uint64_t most_texels_ = 0;
  // The filter error for each voxel format. It is 1, the worst possible error, if the filter cannot
  // be probed.
  std::array<double, 4> filter_error_{1, 1, 1, 1};
};

}  // namespace

std::unique_ptr<measure::Device> make_device(record::Device info,
                                             std::unique_ptr<Context> context) {
  return std::make_unique<GlDevice>(std::move(info), std::move(context));
}

}  // namespace triptych::gl_backend
