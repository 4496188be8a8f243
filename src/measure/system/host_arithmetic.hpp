#pragma once
#include <string>

namespace triptych::measure {

// Restores the default floating-point mode of this thread: rounding to nearest, without flushing
// subnormal numbers to zero. Drivers that generate code change both settings, and some drivers do
// not restore them. Without this function, data that are generated after such a driver has run
// would not be bit-identical to data that are generated before. Returns a description of the
// rounding mode if it was wrong, or an empty string if it was correct.
[[nodiscard]] std::string restore_arithmetic();

}  // namespace triptych::measure
