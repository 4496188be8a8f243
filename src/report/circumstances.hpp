#pragma once
// Facts that a reader of any verdict has to know.

#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// A line about the faults that were injected into the runs, one for each program that measured and
// is not the one that judges, and one for each reason why loaders and drivers could not be used
// while devices were listed.
[[nodiscard]] std::vector<std::string> circumstances(
    std::span<const judge::GateResult* const> results);

// Whether a record was skipped because its data file, which is the reason's subject, is not here.
[[nodiscard]] bool lacks_data(record::Outcome outcome, const record::Reason& reason);

}  // namespace triptych::report
