#pragma once
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// A summary for a pull request: the verdict's line, the worst few, the rest folded.
[[nodiscard]] std::string markdown(const judge::GateResult& result);

}  // namespace triptych::report
