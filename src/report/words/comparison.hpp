#pragma once
// All sentences about comparisons of two devices, drivers, builds or stores. The sentences contain
// messages from drivers and names of data files, so callers must escape them for the output format.
//
// To add a cause, add a value to comparison::DifferenceCause or TimeCause, a row to its table of
// names (comparison/difference.cpp), and a case to the switch in words/comparison.cpp.

#include <optional>
#include <string>
#include <vector>

#include "comparison/comparison.hpp"
#include "comparison/side_by_side.hpp"
#include "comparison/store_diff.hpp"

namespace triptych::report::words {

// Describes one difference: "1000 → 1001 (+0.1 %), although the driver is the same".
[[nodiscard]] std::string text_of(const comparison::Difference& difference);
// Describes a group of differences: "+1.2 % to +40 % in 27 configurations; largest change in X: …".
[[nodiscard]] std::string text_of(const comparison::DifferenceGroup& group);
// Returns one line for each group: "regression    cost: +1.2 % to +40 % in 27 configurations, …".
// If `all` is true, each group is followed by one line for each of its configurations, the largest
// change first.
[[nodiscard]] std::string lines_of(const std::vector<comparison::DifferenceGroup>& groups,
                                   bool all = false);
// Returns why there is no verdict on a time, or "" if there is a verdict.
[[nodiscard]] std::string text_of(const comparison::TimeReason& reason);
[[nodiscard]] std::string text_of(comparison::WallClockCause cause);
// States what only one side has: "plan volume/quick exists only on side a".
[[nodiscard]] std::string text_of(const comparison::OneSidedEntry& only);
// Describes the measurement that is in progress: "fresh process run 2 of 5". A process run is the
// lifetime of one worker process.
[[nodiscard]] std::string stage_of(const comparison::ComparisonProgress& progress);

// States that nothing could be compared. `first` is the reason why the first configuration was not
// measured.
[[nodiscard]] std::string nothing_compared(const comparison::TimeReason& first);
// Names the driver, its version and the version of the API: "driver llvmpipe, Mesa 1; API 1.3".
[[nodiscard]] std::string version_of(const record::Device& device);
// Describes each side in one line, followed by indented lines for its environment variables and
// program. `with_base` states that side a is the argument of `gate --base`.
[[nodiscard]] std::string sides(const comparison::ComparisonResult& result, bool with_base);
// Warns that both sides loaded the same driver version, although the sides select different
// drivers. Each line begins with "!". Returns "" if there is nothing to warn about.
[[nodiscard]] std::string same_driver(const comparison::ComparisonResult& result);
// Returns the mean time ratio and what can be concluded from it.
[[nodiscard]] std::string overall(const comparison::OverallTime& time);
// States the load of the machine (ComparisonResult::other_load).
[[nodiscard]] std::string load(double other_load);
// States what to do if the times of configurations remained undecided. `exact_command` is a command
// that compares numbers of instructions, or empty if the devices do not allow that.
[[nodiscard]] std::string when_undecided(const std::string& exact_command);
// Summarizes a comparison: "FAIL: 18 slower, 3 same; 2 deterministic regressions, 0 fixed, 1
// changed; 64 s".
[[nodiscard]] std::string headline(const comparison::ComparisonResult& result);

// Summarizes a table of two or more devices: "gl:x has the lowest cost in 5 of the 8 techniques
// measured on it; the cost on vulkan:y is 0.98 to 1.30 times as high in the techniques measured on
// both devices".
[[nodiscard]] std::string sentence(const comparison::SideBySide& table);

// Explains the confidence intervals in the table, and whether they cover the variation between
// processes. Returns "" for a table of instructions, which are exact.
[[nodiscard]] std::string uncertainty(const comparison::SideBySide& table);

// States that a frame cannot be reduced, because it fails in a different way when it is drawn
// again. `again` is nullopt if the frame did not fail again.
[[nodiscard]] std::string fails_differently(const judge::Observation& first,
                                            const std::optional<judge::Observation>& again);

}  // namespace triptych::report::words
