#pragma once
// Annotations of a commit for CI systems.

#include <span>
#include <string>

#include "judge/gate/gate.hpp"
#include "report/ci/places.hpp"

namespace triptych::report {

// Workflow commands of GitHub Actions, one on each line: an error for each cause of a regression,
// and a warning for each cause that could not be judged, the worst first. GitHub shows at most ten
// of each for a step, so no more are written.
[[nodiscard]] std::string github_annotations(std::span<const judge::GateResult> results,
                                             const FindingPlaces& places);

// A Code Quality report of GitLab with all of these causes.
[[nodiscard]] std::string gitlab_code_quality(std::span<const judge::GateResult> results,
                                              const FindingPlaces& places);

}  // namespace triptych::report
