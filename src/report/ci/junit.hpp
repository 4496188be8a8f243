#pragma once
#include <span>
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// JUnit XML with a test suite for each plan and check, and a test case for each finding.
// Regressions are failures, what could not be judged is an error, and skips have their reasons.
// Numbers become properties.
[[nodiscard]] std::string junit(std::span<const judge::GateResult> results);
[[nodiscard]] std::string junit(const judge::GateResult& result);

}  // namespace triptych::report
