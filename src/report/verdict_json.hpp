#pragma once
// A verdict for machines.

#include "core/json.hpp"
#include "judge/gate/gate.hpp"

namespace triptych::report {

// {"plan", "run", "exit_code", "headline", "findings": [{"check", "verdict", "test", "device",
// "configuration", "message", "numbers"}], "correlations": [as of the pair], "accuracies": [as of
// the scene]}
[[nodiscard]] core::Json to_json(const judge::GateResult& result);
// {"device_a", "device_b", "signal", "new_device", "line": {"configurations", "intercept", "slope",
// "scale", "rho", "pearson", "admitted", "refusal"}, "points": [{"configuration", "x", "y",
// "residual", "outlier"}]}; what is no number is null.
[[nodiscard]] core::Json to_json(const judge::CorrelationPair& pair);

}  // namespace triptych::report
