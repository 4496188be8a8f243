#pragma once
// The terminal output of `compare`, `diff` and `history`.

#include <string>
#include <vector>

#include "comparison/comparison.hpp"
#include "comparison/history.hpp"
#include "comparison/store_diff.hpp"
#include "report/comparison_command.hpp"

namespace triptych::report {

// Returns the two sides, the differences other than times (the worst kind first), one line for each
// timed configuration, what can be concluded about all of them together, and the verdict. No line
// except a command is wider than 200 characters.
[[nodiscard]] std::string screen_of(const comparison::ComparisonResult& result,
                                    const ComparisonCommand& command);
// Returns, for each device, both driver versions and the differences, the worst kind first.
// `verbose` states whether every configuration with a difference is listed.
[[nodiscard]] std::string screen_of(const comparison::StoreDiff& diff, bool verbose = false);
// Returns, for each device, one line per store, and the first store that is worse than the store
// before it.
[[nodiscard]] std::string screen_of(const std::vector<comparison::DeviceHistory>& history);

}  // namespace triptych::report
