#pragma once
#include <span>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::report {

// Google Benchmark's JSON of runs, one per plan: `context` from the first run's machine with a free
// key per device, and the entries that the library itself wrote while it drove the timed loops,
// each with its "plan", which its name and run_name begin with:
// "volume/quick/gl:llvmpipe-egl/step=1/…".
[[nodiscard]] std::string benchmark_json(const record::Store& store,
                                         std::span<const record::Run> runs);

}  // namespace triptych::report
