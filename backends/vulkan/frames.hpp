#pragma once
#include <array>
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// The commands of a technique, recorded once for each purpose and submitted repeatedly.
class Frames {
 public:
  // `statistics` are the pipeline statistics that are meaningful for this kind of work. Records the
  // commands of `timed` twice: for timing and for the driver's statistics.
  Frames(const Gpu& gpu, vk::QueryPipelineStatisticFlags statistics, const Recording& timed);

  [[nodiscard]] bool can_count() const noexcept { return counters_.has_value(); }
  void record_counters(const Recording& counting);

  // Submits the commands for this purpose. The result contains times and pipeline statistics. It
  // does not contain Triptych's own counters: for Purpose::counters, shaders write them to a
  // buffer, which the caller reads.
  [[nodiscard]] measure::Frame submit(measure::Purpose purpose) const;

 private:
  struct Recorded {
    vk::raii::CommandBuffer commands;
    vk::raii::QueryPool queries;  // null if there is nothing to query
  };
  [[nodiscard]] Recorded record(const Recording& work, vk::QueryType type, bool queried) const;
  [[nodiscard]] std::optional<double> device_ns() const;
  [[nodiscard]] record::Counts statistics() const;

  const Gpu& gpu_;
  vk::QueryPipelineStatisticFlags statistic_flags_;
  vk::raii::Fence fence_;
  Recorded timed_;
  Recorded counted_by_driver_;
  std::optional<Recorded> counters_;
};

}  // namespace triptych::vulkan_backend
