#pragma once
#include <span>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::report {

// Returns runs in the JSON format of Google Benchmark. There is one run for each plan. `context`
// describes the machine of the first run, with one additional key for each device. The entries were
// written by Google Benchmark, which drives the timed loops. Each entry also has the key "plan",
// and its name and run_name begin with the plan: "volume/quick/gl:llvmpipe-egl/step=1/…".
[[nodiscard]] std::string benchmark_json(const record::Store& store,
                                         std::span<const record::Run> runs);

}  // namespace triptych::report
