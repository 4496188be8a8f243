#pragma once
// Notes about runs, such as injected faults or missing data files, that the reader of a verdict
// must know even if the run passed.

#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Returns lines about injected faults, baselines outside the working directory, driver versions
// that were never accepted, other builds of Triptych that measured a part of a run, runs that are
// older than a day, loaders and drivers that failed during device enumeration (one line for each
// reason), missing data files, and waivers that have no effect.
[[nodiscard]] std::vector<std::string> circumstances(
    std::span<const judge::GateResult* const> results);

}  // namespace triptych::report
