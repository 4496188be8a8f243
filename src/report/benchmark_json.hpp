#pragma once
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::report {

// Google Benchmark's JSON of a run: `context` from the run's machine with a free key per device,
// and the entries that the library itself wrote while it drove the timed loops.
[[nodiscard]] std::string benchmark_json(const record::Store& store, const std::string& run);

}  // namespace triptych::report
