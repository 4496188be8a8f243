#pragma once
#include <vector>

#include "judge/baselines/baselines.hpp"
#include "judge/finding.hpp"
#include "judge/gate/open_counts.hpp"

namespace triptych::judge {

// Returns the counters of a record that differ from the counters of other devices by more than is
// allowed. Counters that the record or the other devices lack are not compared.
[[nodiscard]] std::vector<Change> counter_changes(const record::Record& record,
                                                  const StoredCounters& other_devices,
                                                  const FindOpenCounts& open_counts);

}  // namespace triptych::judge
