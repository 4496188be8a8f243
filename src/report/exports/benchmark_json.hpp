#pragma once
#include <span>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::report {

// Writes runs as the JSON of Google Benchmark, one per plan. `context` describes the machine of the
// first run, with one additional key for each device. The entries are those that the library wrote
// while it drove the timed loops. Each also has its "plan", with which its name and run_name begin:
// "volume/quick/gl:llvmpipe-egl/step=1/…".
[[nodiscard]] std::string benchmark_json(const record::Store& store,
                                         std::span<const record::Run> runs);

}  // namespace triptych::report
