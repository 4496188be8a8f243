#pragma once
// The difference of two counts of one frame, and whether it is allowed.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/finding.hpp"
#include "record/record.hpp"

namespace triptych::judge {

// The parts of Record::cost that affect the verdict.
inline constexpr std::array<std::string_view, 2> cost_parts{"device_code", "driver"};

[[nodiscard]] std::optional<double> count_of(const record::Counts& counts, std::string_view name);
// The sum of the instructions of these parts.
[[nodiscard]] double frame_of(const record::Counts& cost);

struct FrameChange {
  bool more = false;            // some part is larger than its tolerance allows
  bool less = false;            // some part is smaller than its tolerance allows
  std::vector<Change> changes;  // the changes of each such part, and of the allocations
};

// Uses cost_tolerance.hpp, so both counts must come from the same emulator, program and driver.
[[nodiscard]] FrameChange frame_change(const record::Record& now, const record::Counts& before);

}  // namespace triptych::judge
