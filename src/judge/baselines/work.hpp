#pragma once
// Splits a change of time: Δ ln t = Δ ln(work) + Δ ln(time per unit of work).

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "judge/baselines/baselines.hpp"

namespace triptych::judge {

// Counters to which the time of a technique is proportional. The first counter that both sides have
// is used as the amount of work.
inline constexpr std::array<std::string_view, 2> work_units{"samples", "fragments"};

struct WorkChange {
  double log_ratio = 0;  // ln(work now/work then)
  std::string unit;      // one of work_units
};

// Empty if the two sides have no unit in common, or if one of them has 0 of it. `then` returns the
// earlier count of a unit.
[[nodiscard]] std::optional<WorkChange> work_change(
    const record::Counts& now,
    const std::function<std::optional<double>(const std::string&)>& then);
[[nodiscard]] std::optional<WorkChange> work_change(const record::Counts& now,
                                                    const record::Counts& then);
// Compares with the counts that are stored for the configuration on a device.
[[nodiscard]] std::optional<WorkChange> work_change(const record::Counts& now,
                                                    const Baselines& baselines,
                                                    const std::string& configuration,
                                                    const std::string& device);

}  // namespace triptych::judge
