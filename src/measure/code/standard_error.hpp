#pragma once
// Some drivers report their compiled code only on standard error.

#include <functional>
#include <string>

namespace triptych::measure {

// Returns the text that `act`, and the drivers that it calls, wrote to standard error. The text is
// not passed on. Standard error is restored when `act` ends, also by an exception. Two threads must
// not call this at the same time.
[[nodiscard]] std::string standard_error_of(const std::function<void()>& act);

}  // namespace triptych::measure
