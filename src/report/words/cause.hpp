#pragma once
// Sentences about a group of findings with the same cause, and about exit codes. They contain
// messages from drivers and names of data files, so callers must escape them.

#include <string>
#include <string_view>
#include <vector>

#include "report/overview.hpp"

namespace triptych::report::words {

// Returns the configuration, or "12 configurations" if there are several. Returns "" for a finding
// about a whole device or plan.
[[nodiscard]] std::string subject(const FindingGroup& group);
// Returns the devices of the group, or "9 devices" if there are more than three.
[[nodiscard]] std::string devices(const FindingGroup& group);
// Returns where the findings are: "vulkan:lavapipe, technique=raycast (12 configurations)", or the
// plans if the findings belong to no device.
[[nodiscard]] std::string location(const Cause& cause);
// Describes the worst finding of the group. Also lists the devices on which the smallest
// configuration is correct, and the number of configurations whose counters changed, too.
[[nodiscard]] std::string found(const Cause& cause);
// States whether the driver is at fault. Returns "" if the results of other devices do not reveal
// this.
[[nodiscard]] std::string attribution(const FindingGroup& group);
// Returns found(), attribution() and the advice in one line.
[[nodiscard]] std::string text_of(const Cause& cause);

// Describes a group of waived findings: the date and the reason of the waiver, the place, and the
// worst finding.
[[nodiscard]] std::string waived_text(const Cause& cause);

// Returns at most three lines that suggest the next commands after a regression, or no lines if
// there is no regression. `store_option` is " --store FILE", or empty for the default store.
[[nodiscard]] std::vector<std::string> next_steps(const Overview& all,
                                                  std::string_view store_option);

// Returns "FAIL", "PASS" or "CANNOT JUDGE".
[[nodiscard]] std::string_view verdict_word(core::ExitCode code);
// Explains a pass: "every requested check passed", or which checks reached no verdict.
[[nodiscard]] std::string pass_text(const Overview& all);
// Explains the exit code: "1: something is wrong or has changed".
[[nodiscard]] std::string meaning_of(const Overview& all);

}  // namespace triptych::report::words
