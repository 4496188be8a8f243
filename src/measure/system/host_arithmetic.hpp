#pragma once
#include <string>

namespace triptych::measure {

// What the floating-point arithmetic of this thread is no longer by default: the rounding mode, or
// subnormal numbers that are taken for 0. Drivers that generate code change both, and some forget to
// change them back; data that are generated afterwards have other bits. Restores the default.
// Empty where nothing was changed.
[[nodiscard]] std::string restore_arithmetic();

}  // namespace triptych::measure
