#pragma once
// Regressions that were drawn again, and what a run leaves for the next to expect.

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::judge {

// What the message of a finding begins with that GateRequest::known excused; its kind follows.
inline constexpr std::string_view known_prefix = "known ";
// What that of a regression begins with that was none when it was drawn again.
inline constexpr std::string_view flake_prefix = "flake, right when drawn again: ";

// What that of a hang ends with which was right when it was drawn again: a time tells no hang from
// a slow driver on a busy machine.
inline constexpr std::string_view slow_suffix =
    "; right when drawn again: slow, or it hangs at times; --limit gives it longer";

using Places = std::set<std::pair<std::string, std::string>>;  // device, configuration

// Where the result has regressions of a configuration.
[[nodiscard]] Places failing(const GateResult& result);

struct Redrawn {
  GateResult result;  // of the second time; flakes are regressions that say so, hangs undecided
  Places flakes;
};

// `first` and `second`: the same run judged before and after `places` were drawn again.
[[nodiscard]] Redrawn tell_flakes(const GateResult& first, GateResult second, const Places& places);

// What fails, flakes or is skipped in the results, waived by no file but that of such.
[[nodiscard]] std::vector<Waiver> as_expected(std::span<const GateResult> results);

}  // namespace triptych::judge
