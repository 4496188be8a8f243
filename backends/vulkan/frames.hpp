#pragma once
#include <array>
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// The work of a technique, which is recorded once for each purpose and submitted repeatedly.
class Frames {
 public:
  // `statistics` are the pipeline statistics that are meaningful for this kind of work. The
  // constructor makes both recordings.
  Frames(const Gpu& gpu, vk::QueryPipelineStatisticFlags statistics, const Recording& timed);

  [[nodiscard]] bool can_count() const noexcept { return counters_.has_value(); }
  void record_counters(const Recording& counting);

  // Submits the recording for this purpose and fills in times and statistics. The caller reads the
  // counters, which its counting build has written.
  [[nodiscard]] measure::Frame submit(measure::Purpose purpose) const;

 private:
  struct Recorded {
    vk::raii::CommandBuffer commands;
    vk::raii::QueryPool queries;  // null if nothing is queried
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
