#pragma once
// Captures standard error, because some drivers report their compiled code only there.

#include <functional>
#include <string>

namespace triptych::measure {

// Returns what `act` and the drivers that it calls write to standard error. This output does not
// appear on the original standard error, which is restored when `act` returns or throws. Two
// threads must not call this function at the same time.
[[nodiscard]] std::string standard_error_of(const std::function<void()>& act);

}  // namespace triptych::measure
