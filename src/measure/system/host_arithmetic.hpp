#pragma once
#include <string>

namespace triptych::measure {

// Restores the default floating-point arithmetic of this thread: rounding to nearest, with
// subnormal numbers. Drivers that generate code change both, and some do not restore them, so that
// data that are generated afterwards have other bits. Returns the wrong rounding mode in words;
// empty if it was not changed.
[[nodiscard]] std::string restore_arithmetic();

}  // namespace triptych::measure
