#pragma once
// What a reader of a verdict has to know, whatever the verdict is.

#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// One line for each, without repetitions: faults that were injected into the runs, loaders and
// drivers that could not be used while devices were listed, and the program that measured if it is
// not the one that judges.
[[nodiscard]] std::vector<std::string> circumstances(
    std::span<const judge::GateResult* const> results);

}  // namespace triptych::report
