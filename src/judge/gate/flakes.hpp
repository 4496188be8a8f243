#pragma once
// Handles regressions that were drawn a second time, and lists the results that the next run should
// expect.

#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

using Places = std::set<std::pair<std::string, std::string>>;  // device, configuration

// The places at which the result has regressions of a configuration.
[[nodiscard]] Places failing(const GateResult& result);

struct Redrawn {
  // the second attempt, in which flakes stay regressions, and timeouts are undecided
  GateResult result;
  Places flakes;
};

// `first` and `second` judge the same run, before and after `places` were drawn again.
[[nodiscard]] Redrawn tell_flakes(const GateResult& first, GateResult second, const Places& places);

// The failures, flakes and skips in the results that are not waived, except by the file of expected
// results itself. `reason_of` gives the text for people who read the file.
[[nodiscard]] std::vector<Waiver> as_expected(
    std::span<const GateResult> results,
    const std::function<std::string(const Finding&)>& reason_of);

}  // namespace triptych::judge
