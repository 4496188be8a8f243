#pragma once
// Combines regressions with the results of a second attempt to draw them, and lists the failures
// and skips that the next run should expect.

#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

using CaseSet = std::set<std::pair<std::string, std::string>>;  // device, configuration

// Returns the device and the configuration of each regression.
[[nodiscard]] CaseSet failing_cases(const GateResult& result);

struct SecondAttempt {
  // The result of the second attempt. A failure that did not recur in the second attempt is still a
  // regression, marked as a flake. A timeout that did not recur cannot be judged.
  GateResult result;
  CaseSet flakes;
};

// Finds the flakes. `first` and `second` are the results before and after `cases` were drawn
// again.
[[nodiscard]] SecondAttempt mark_flakes(const GateResult& first, GateResult second,
                                        const CaseSet& cases);

// Returns the entries of a new file of expectations (the list of known failures that `validate`
// writes): all failures, flakes and skips in the results, except those that waivers.json excuses.
// `reason_of` returns the reason that is written for a human reader.
[[nodiscard]] std::vector<Waiver> expected_outcomes_of(
    std::span<const GateResult> results,
    const std::function<std::string(const Finding&)>& reason_of);

}  // namespace triptych::judge
