#pragma once
// Which clock measured the times of a run.

#include <cstddef>
#include <map>
#include <string>

#include "record/store.hpp"

namespace triptych::record {

// The number of timed configurations for each clock (Record::clock).
using ClockCounts = std::map<std::string, std::size_t>;

// Returns the clocks of a run for each device on which times were measured.
[[nodiscard]] std::map<std::string, ClockCounts> clock_counts(const Store& store,
                                                              const std::string& run);

// Returns the id of the latest run of the same plan that is older than `run`, or an empty string.
[[nodiscard]] std::string previous_run(const Store& store, const std::string& run);

}  // namespace triptych::record
