#pragma once
// The JSON output of `gate` and `validate` (docs/report.md).

#include <vector>

#include "core/json.hpp"
#include "judge/gate/gate.hpp"

namespace triptych::report {

// Returns {"plan", "run", "exit_code", "headline", "findings": [one object for each finding],
// "correlations": [one object for each pair of devices], "accuracies": [one object for each scene]}
[[nodiscard]] core::Json to_json(const judge::GateResult& result);
// Returns {"check", "verdict", "cause", "test", "device", "configuration", "message", "numbers"}
// and, if they are not empty, {"against", "advice": {"kind", "command"}, "changes": [{"name",
// "unit", "before", "now", "accepted", "allowed"}], "names", "facts", "detail", "outcome",
// "reason", "because", "subject", "injected", "excuse", "drawn_again", "again", "measured_before"}.
[[nodiscard]] core::Json to_json(const judge::Finding& finding);
// Returns [{"name", "unit", "before", "now", "accepted", "allowed"}]
[[nodiscard]] core::Json changes_json(const std::vector<judge::Change>& changes);
// Returns the members of a finding that come from judge::Observation. Empty members are left out,
// except "cause" and "numbers".
[[nodiscard]] core::Json observation_json(const judge::Observation& what);
// Returns {"device_a", "device_b", "signal", "new_device", "line": {"configurations", "intercept",
// "slope", "scale", "rho", "pearson", "admitted", "refusal"}, "points": [{"configuration", "x",
// "y", "residual", "outlier"}]}. NaN and infinities are null.
[[nodiscard]] core::Json to_json(const judge::CorrelationPair& pair);

}  // namespace triptych::report
