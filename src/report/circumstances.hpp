#pragma once
// Facts that readers of any verdict must know.

#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Returns a line about the faults that were injected into the runs, a line for each build of
// Triptych that measured and is not the one that judges, and a line for each reason why a loader or
// driver could not be used while devices were listed.
[[nodiscard]] std::vector<std::string> circumstances(
    std::span<const judge::GateResult* const> results);

// Whether a record was skipped because its data file, which is the reason's subject, is missing on
// this machine.
[[nodiscard]] bool lacks_data(record::Outcome outcome, const record::Reason& reason);

}  // namespace triptych::report
