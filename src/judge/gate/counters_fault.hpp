#pragma once
#include <string>

#include "judge/baselines/baselines.hpp"
#include "judge/gate/open_counts.hpp"

namespace triptych::judge {

// How a record's counters differ from those of other devices by more than they may; empty: they do
// not. What one of them does not count is not held against it.
[[nodiscard]] std::string counters_fault(const record::Record& record,
                                         const StoredCounters& of_others,
                                         const FindOpenCounts& open_counts);

}  // namespace triptych::judge
