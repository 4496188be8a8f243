#pragma once
// Texts about a group of findings with one cause, and about exit codes. They quote drivers and
// data, so callers must escape them.

#include <string>
#include <string_view>
#include <vector>

#include "report/overview.hpp"

namespace triptych::report::words {

// The configuration, or "12 configurations"; empty for a finding about a whole device or plan.
[[nodiscard]] std::string subject(const FindingGroup& group);
// "vulkan:lavapipe, technique=raycast (12 configurations)"; the plans if neither is known.
[[nodiscard]] std::string place(const Cause& cause);
// The finding for the worst configuration, and the devices that pass it.
[[nodiscard]] std::string found(const Cause& cause);
// The component at fault; empty if the other devices do not reveal it.
[[nodiscard]] std::string blame(const FindingGroup& group);
// The finding, the component at fault and the advice.
[[nodiscard]] std::string text_of(const Cause& cause);

// Two lines about the next steps after a regression, with suitable commands; none if there is no
// regression. `store_option` is " --store FILE", or empty for the default.
[[nodiscard]] std::vector<std::string> next_steps(const Overview& all,
                                                  std::string_view store_option);

// "FAIL", "PASS", "CANNOT JUDGE"
[[nodiscard]] std::string_view word_of(core::ExitCode code);
// "1: something is wrong", for people who see only the number.
[[nodiscard]] std::string_view meaning_of(core::ExitCode code);

}  // namespace triptych::report::words
