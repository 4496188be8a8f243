#pragma once
// What a reader of a verdict has to know, whatever the verdict is.

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

}  // namespace triptych::report
