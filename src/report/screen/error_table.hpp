#pragma once
// The result of `--error E`: for each scene, a table with the fastest settings of each device and
// technique.

#include <string>
#include <vector>

#include "measure/request/error_answer.hpp"

namespace triptych::report {

// Returns the tables. Each table is sorted by time, fastest first, and is followed by a sentence
// that names the fastest settings and those that are not clearly slower. `answers` are in the order
// that measure::answer_error() returns.
[[nodiscard]] std::string error_tables(const std::vector<measure::ErrorAnswer>& answers,
                                       const accuracy::RequestedError& request);

}  // namespace triptych::report
