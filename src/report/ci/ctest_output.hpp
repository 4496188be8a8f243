#pragma once
// The output of a CTest test that runs a check: text for the log, and numbers and images for the
// dashboard.

#include <optional>
#include <string>

#include "judge/gate/gate.hpp"
#include "judge/stress/stress.hpp"
#include "record/store.hpp"

namespace triptych::report {

// Returns the findings that do not pass, the numbers of the worst finding, and a one-line summary.
// If `truth` is not empty, also writes the device image, the reference image and the difference
// image for the worst finding to a temporary folder and adds their paths.
[[nodiscard]] std::string ctest_output(const judge::GateResult& result, const record::Store& store,
                                       const judge::FindTruth& truth);

// Returns the reason why the test counts as skipped, or nullopt if it does not. A check with only
// advisories and skips has judged nothing, so it must not count as a pass.
[[nodiscard]] std::optional<std::string> skip_reason(const judge::GateResult& result);

}  // namespace triptych::report
