#pragma once
#include <array>
#include <optional>

#include "backends/vulkan/gpu.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::vulkan_backend {

// What a technique draws, recorded once per purpose and submitted again and again.
class Frames {
 public:
  // `statistics` are the pipeline statistics that mean something for this kind of work. Both
  // recordings are made here.
  Frames(const Gpu& gpu, vk::QueryPipelineStatisticFlags statistics, const Recording& timed);

  [[nodiscard]] bool can_count() const noexcept { return counters_.has_value(); }
  void record_counters(const Recording& counting);

  // Submits the recording for this purpose. Fills in times and statistics; counters are the
  // caller's, where its counting build left them.
  [[nodiscard]] measure::Frame submit(measure::Purpose purpose) const;

 private:
  struct Recorded {
    vk::raii::CommandBuffer commands;
    vk::raii::QueryPool queries;  // null where there is nothing to query
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
