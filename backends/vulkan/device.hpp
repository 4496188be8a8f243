#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "backends/vulkan/devices.hpp"
#include "backends/vulkan/gpu.hpp"
#include "backends/vulkan/instance.hpp"
#include "measure/contract/backend.hpp"
#include "measure/contract/features.hpp"

namespace triptych::vulkan_backend {

// An open physical device.
class Device final : public measure::Device, public measure::FeatureProber {
 public:
  // Probes the texture filter of every voxel format. Throws core::NotSupported or core::ApiError.
  Device(std::unique_ptr<const Instance> instance, Candidate candidate);

  [[nodiscard]] const record::Device& info() const override { return info_; }
  [[nodiscard]] std::optional<std::string> unsupported(const measure::Work& work) const override;
  [[nodiscard]] measure::VolumePath default_path(const measure::VolumeKind& volume) const override;
  [[nodiscard]] double filter_weight_error(const measure::VolumePath& path) const override;
  [[nodiscard]] std::optional<measure::Rasterizer> rasterizer() const override;
  [[nodiscard]] record::Counts memory() const override { return gpu_.memory_ledger.counts(); }
  [[nodiscard]] std::unique_ptr<measure::Prepared> prepare(const measure::Work& work) override;
  [[nodiscard]] measure::Compiled compile(const measure::Work& work) override;
  [[nodiscard]] std::vector<measure::FeatureProbe> feature_probes() override;

 private:
  [[nodiscard]] std::optional<double> hardware_error(scene::VoxelFormat format) const;

  std::unique_ptr<const Instance> instance_;
  record::Device info_;
  Gpu gpu_;
  std::array<std::optional<double>, 4> filter_errors_;  // indexed by VoxelFormat
};

}  // namespace triptych::vulkan_backend
