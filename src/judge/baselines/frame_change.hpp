#pragma once
// Compares the stored and the current instruction counts of a frame.

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
// Returns the number of instructions of the whole frame: the sum over cost_parts.
[[nodiscard]] double frame_instructions(const record::Counts& cost);

struct FrameChange {
  bool increased = false;       // the count of some part increased by more than its tolerance
  bool decreased = false;       // the count of some part decreased by more than its tolerance
  std::vector<Change> changes;  // changed parts and, if there are any, changed allocations
};

// Compares the counts of `now` with the counts `before`, with the tolerances of cost_tolerance.hpp.
// The tolerances are valid only for counts of the same program and driver by the same emulator.
[[nodiscard]] FrameChange frame_change(const record::Record& now, const record::Counts& before);

}  // namespace triptych::judge
