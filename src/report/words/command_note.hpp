#pragma once
#include <string>

#include "judge/gate/gate.hpp"

namespace triptych::report::words {

// Returns a sentence to print next to command_of() if the command leaves out environment variables
// that may have selected the driver: names the variables, and the driver version that the command
// must use. Returns "" if the command leaves out nothing, or if there is no command. Contains
// text from the store, so callers must escape it.
[[nodiscard]] std::string command_note(const judge::Finding& finding,
                                       const judge::GateResult& result);

}  // namespace triptych::report::words
