#pragma once
#include <string>

namespace triptych::measure {

// Restores the default floating-point arithmetic of this thread: rounding to nearest, with subnormal
// numbers. Drivers that generate code change both, and some forget to change them back; data that are
// generated afterwards have other bits. Returns the rounding mode that was changed, in words; empty
// where it was not.
[[nodiscard]] std::string restore_arithmetic();

}  // namespace triptych::measure
