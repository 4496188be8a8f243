#pragma once
// Captures standard error, because some drivers report their compiled code only there.

#include <functional>
#include <string>

namespace triptych::measure {

// Returns what `act` and the drivers that it calls write to standard error. This output does not
// appear on the original standard error, which is restored when `act` returns or throws. Two
// threads must not call this function at the same time.
[[nodiscard]] std::string capture_stderr(const std::function<void()>& action);

}  // namespace triptych::measure
