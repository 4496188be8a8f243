#pragma once
#include <span>
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// JUnit XML: one test suite per plan and check, one case per finding; regressions are failures,
// what could not be judged is an error, skips keep their reason. Numbers become properties.
[[nodiscard]] std::string junit(std::span<const judge::GateResult> results);
[[nodiscard]] std::string junit(const judge::GateResult& result);

}  // namespace triptych::report
