#pragma once
// The JSON output of `compare`, `diff` and `history` (docs/compare.md).

#include <vector>

#include "comparison/comparison.hpp"
#include "comparison/history.hpp"
#include "comparison/side_by_side.hpp"
#include "comparison/store_diff.hpp"
#include "core/json.hpp"
#include "report/comparison_command.hpp"

namespace triptych::report {

// Returns {"kind", "about", "cause", "text"} and, if they are not empty, {"ratio", "side",
// "numbers", "facts", "changes", "a" and "b" (observations), "worths", "code", "total",
// "injected"}.
[[nodiscard]] core::Json to_json(const comparison::Difference& difference);
// Returns the members of a Difference and, in addition, {"configuration", "configurations",
// "ratio_low", "ratio_high"}.
[[nodiscard]] core::Json to_json(const comparison::DifferenceGroup& group);
// Returns {"cause", "text"} and, depending on the cause, {"side", "outcome", "reason", "suspected",
// "numbers"}.
[[nodiscard]] core::Json to_json(const comparison::TimeReason& reason);

// Returns {"plan", "sides", "a", "b" (devices), "seconds", "exit_code", "headline", "differences"
// (between the devices), "overall" (mean of the time ratios), "other_load",
// "ineffective_variables", "configurations": [{"configuration", "reason", "differences", "work"; if
// times were compared: "verdict", "a", "b" (median and quartiles of the frame times), "ratio",
// "ratio_low", "ratio_high", "blocks", "process_runs", "frames_per_batch", "clock", "why_wall",
// "seconds", "settle" (a command, if the budget ended before a verdict)}]}. Unknown values are left
// out.
[[nodiscard]] core::Json to_json(const comparison::ComparisonResult& result,
                                 const ComparisonCommand& command);

// Returns {"exit_code", "only_one": [{"plan", "device", "side", "text"}], "devices": [{"a", "b"
// (devices), "differences" (between the devices), "configurations": [{"configuration",
// "differences"}]}]}
[[nodiscard]] core::Json to_json(const comparison::StoreDiff& diff);

// Returns [{"device", "first_worse", "points": [{"store", "name", "started_at", "driver_version",
// "triptych", "injected", "cost", "time", "time_change": {"ratio", "half_width", "noise", "text"},
// "changed_clocks" (a sentence), "changes", "differences", "worse"}]}]. "changes" contains the
// differences as one human-readable string. Unknown values are left out.
[[nodiscard]] core::Json to_json(const std::vector<comparison::DeviceHistory>& history);

[[nodiscard]] core::Json to_json(const comparison::SideBySide& table);

}  // namespace triptych::report
