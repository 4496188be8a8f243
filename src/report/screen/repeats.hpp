#pragma once
// The output of `validate --repeat`.

#include <cstddef>
#include <span>
#include <string>

#include "judge/gate/repeats.hpp"

namespace triptych::report {

// Returns one line for each case that fails in only some repetitions and for each case whose image
// changes between repetitions, and a last line with the totals.
[[nodiscard]] std::string repeats_text(std::span<const judge::RepeatedCase> cases,
                                       std::size_t repetitions);

// Returns JSON lines, with one object for each case.
[[nodiscard]] std::string repeats_json_lines(std::span<const judge::RepeatedCase> cases);

}  // namespace triptych::report
