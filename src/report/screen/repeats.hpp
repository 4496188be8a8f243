#pragma once
// The results of `validate --repeat` for its cases.

#include <cstddef>
#include <span>
#include <string>

#include "judge/gate/repeats.hpp"

namespace triptych::report {

// One line of text for each case that fails in only some repetitions, or whose image changes, and a
// last line with the totals.
[[nodiscard]] std::string repeats_text(std::span<const judge::RepeatedCase> cases,
                                       std::size_t repetitions);

// One JSON object in one line for each case.
[[nodiscard]] std::string repeats_json_lines(std::span<const judge::RepeatedCase> cases);

}  // namespace triptych::report
