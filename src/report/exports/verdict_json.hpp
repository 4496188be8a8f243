#pragma once
// A verdict in machine-readable form.

#include <vector>

#include "core/json.hpp"
#include "judge/gate/gate.hpp"

namespace triptych::report {

// {"plan", "run", "exit_code", "headline", "findings": [see to_json of a finding], "correlations":
// [see to_json of a pair], "accuracies": [for each scene]}
[[nodiscard]] core::Json to_json(const judge::GateResult& result);
// {"check", "verdict", "cause", "test", "device", "configuration", "message", "numbers"}, and the
// following members if they are not empty: {"against", "advice": {"kind", "command"}, "changes":
// [{"name", "unit", "before", "now", "accepted", "allowed"}], "names", "facts", "detail",
// "outcome", "reason", "because", "subject", "injected", "excuse", "drawn_again", "again",
// "measured_before"}.
[[nodiscard]] core::Json to_json(const judge::Finding& finding);
// [{"name", "unit", "before", "now", "accepted", "allowed"}]
[[nodiscard]] core::Json changes_json(const std::vector<judge::Change>& changes);
// The members of a finding that describe what was observed. Empty ones are left out, except "cause"
// and "numbers".
[[nodiscard]] core::Json observation_json(const judge::Observation& what);
// {"device_a", "device_b", "signal", "new_device", "line": {"configurations", "intercept", "slope",
// "scale", "rho", "pearson", "admitted", "refusal"}, "points": [{"configuration", "x", "y",
// "residual", "outlier"}]}. NaN and infinities are null.
[[nodiscard]] core::Json to_json(const judge::CorrelationPair& pair);

}  // namespace triptych::report
