#pragma once
// Regressions that were drawn again, and what a run leaves for the next to expect.

#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

using Places = std::set<std::pair<std::string, std::string>>;  // device, configuration

// Where the result has regressions of a configuration.
[[nodiscard]] Places failing(const GateResult& result);

struct Redrawn {
  GateResult result;  // of the second time; flakes stay regressions, timeouts are undecided
  Places flakes;
};

// `first` and `second`: the same run judged before and after `places` were drawn again.
[[nodiscard]] Redrawn tell_flakes(const GateResult& first, GateResult second, const Places& places);

// What fails, flakes or is skipped in the results, waived by no file but that of such.
// `reason_of`: the words for a person who reads the file.
[[nodiscard]] std::vector<Waiver> as_expected(
    std::span<const GateResult> results,
    const std::function<std::string(const Finding&)>& reason_of);

}  // namespace triptych::judge
