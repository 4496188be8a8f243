#pragma once
// The results of `compare`, `diff` and `history` as they are printed on a terminal.

#include <string>
#include <vector>

#include "comparison/comparison.hpp"
#include "comparison/history.hpp"
#include "comparison/store_diff.hpp"
#include "report/comparison_command.hpp"

namespace triptych::report {

// The differences except times with the worst kind first, then one line for each configuration that
// was timed, then the verdict.
[[nodiscard]] std::string screen_of(const comparison::ComparisonResult& result,
                                    const ComparisonCommand& command);
// Each device with both versions, then its differences with the worst kind first.
[[nodiscard]] std::string screen_of(const comparison::StoreDiff& diff);
// Each device with one line per store, then the first store that was worse.
[[nodiscard]] std::string screen_of(const std::vector<comparison::DeviceHistory>& history);

}  // namespace triptych::report
