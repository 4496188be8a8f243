#pragma once
// Formats findings as annotations, which CI systems attach to lines of a commit.

#include <span>
#include <string>

#include "judge/gate/gate.hpp"
#include "report/ci/finding_locations.hpp"

namespace triptych::report {

// Returns GitHub Actions workflow commands, one per line, the worst first: an error for each cause
// of a regression, and a warning for each cause that could not be judged. Returns at most ten
// errors and ten warnings, because GitHub shows no more for a step.
[[nodiscard]] std::string github_annotations(std::span<const judge::GateResult> results,
                                             const FindingLocations& locations);

// Returns a GitLab Code Quality report with all causes of regressions and all causes that could not
// be judged.
[[nodiscard]] std::string gitlab_code_quality(std::span<const judge::GateResult> results,
                                              const FindingLocations& locations);

}  // namespace triptych::report
