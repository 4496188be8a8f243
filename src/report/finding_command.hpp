#pragma once
// The commands with which a user reproduces findings.

#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Returns whether `triptych render` reproduces the finding, so that `triptych reduce` finds a
// smaller frame that fails. This includes hangs, because both commands have a time limit.
[[nodiscard]] bool is_reproduced_by_render(const judge::Finding& finding);

// Returns a command that reproduces a finding of the result and that users can copy. It sets the
// environment variables with which the device was measured. Returns "" if there is no such command.
[[nodiscard]] std::string command_of(const judge::Finding& finding,
                                     const judge::GateResult& result);

}  // namespace triptych::report
