#pragma once
#include <string>

namespace triptych::measure {

// Restores the default floating-point arithmetic of this thread: rounding to nearest, with
// subnormal numbers. Drivers that generate code change both, and some drivers do not restore them,
// so that data that are generated afterwards would not be bit-identical. Returns a description of
// the wrong rounding mode, or an empty string if the rounding mode was correct.
[[nodiscard]] std::string restore_arithmetic();

}  // namespace triptych::measure
