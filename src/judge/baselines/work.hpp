#pragma once
// Computes how much of a change in the frame time t comes from a changed amount of work:
// Δ ln t = Δ ln(work) + Δ ln(time per unit of work). One of Triptych's counters measures the
// work, so a unit of work is, for example, one sample.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "judge/baselines/baselines.hpp"

namespace triptych::judge {

// Counters to which the time of a technique is proportional. The first of these counters that is
// present in both runs is used as the amount of work.
inline constexpr std::array<std::string_view, 2> work_units{"samples", "fragments"};

struct WorkChange {
  double log_ratio = 0;  // ln(work now/work then)
  std::string unit;      // the counter that measures the work, one of work_units
};

// Compares the counts `now` with earlier counts; `before` returns the earlier count of a counter.
// Returns nullopt if none of the counters in work_units has a positive count in both runs.
[[nodiscard]] std::optional<WorkChange> work_change(
    const record::Counts& now,
    const std::function<std::optional<double>(const std::string&)>& before);
[[nodiscard]] std::optional<WorkChange> work_change(const record::Counts& now,
                                                    const record::Counts& before);
// Compares the counts `now` with the counts that are stored for the configuration on the device.
[[nodiscard]] std::optional<WorkChange> work_change(const record::Counts& now,
                                                    const Baselines& baselines,
                                                    const std::string& configuration,
                                                    const std::string& device);

}  // namespace triptych::judge
