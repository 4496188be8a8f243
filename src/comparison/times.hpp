#pragma once
// The second half of a comparison, which measures interleaved frame times of the two compared
// devices, drivers or builds (sides a and b).

#include <optional>
#include <vector>

#include "comparison/comparison.hpp"
#include "measure/system/stopwatch.hpp"

namespace triptych::comparison {

// Sets the verdict on the time of each configuration, unless a comparison of its times would be
// meaningless. Returns ComparisonResult::other_load. `since` measures from the start of the
// comparison, because the budget includes the deterministic measurements. Throws the same
// exceptions as measure::Interleaved.
std::optional<double> measure_times(const ComparisonOptions& options,
                                    const measure::Stopwatch& since, const OnProgress& on_progress,
                                    std::vector<ComparedConfiguration>& compared);

}  // namespace triptych::comparison
