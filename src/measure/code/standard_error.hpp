#pragma once
// Some drivers print what they compiled on standard error and nowhere else.

#include <functional>
#include <string>

namespace triptych::measure {

// Returns the text that `act`, and the drivers that it calls, wrote to standard error. Nobody else
// sees that text. Standard error is restored when `act` ends, also by an exception. Two threads must
// not call it at once.
[[nodiscard]] std::string standard_error_of(const std::function<void()>& act);

}  // namespace triptych::measure
