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

using Places = std::set<std::pair<std::string, std::string>>;  // device, configuration

// Returns the device and the configuration of each regression.
[[nodiscard]] Places failing(const GateResult& result);

struct Redrawn {
  // The result of the second attempt. A failure that did not recur in the second attempt is still a
  // regression, marked as a flake. A timeout that did not recur cannot be judged.
  GateResult result;
  Places flakes;
};

// Finds the flakes. `first` and `second` are the results before and after `places` were drawn
// again.
[[nodiscard]] Redrawn tell_flakes(const GateResult& first, GateResult second, const Places& places);

// Returns the entries of a new file of expectations (the list of known failures that `validate`
// writes): all failures, flakes and skips in the results, except those that waivers.json excuses.
// `reason_of` returns the reason that is written for a human reader.
[[nodiscard]] std::vector<Waiver> as_expected(
    std::span<const GateResult> results,
    const std::function<std::string(const Finding&)>& reason_of);

}  // namespace triptych::judge
