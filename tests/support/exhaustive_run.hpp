#pragma once
#include <cstdlib>

namespace triptych::test {

// Returns whether the nightly run requests every combination on every device
// (TRIPTYCH_EVERY_DEVICE).
inline bool is_exhaustive_run() {
  const char* const every = std::getenv("TRIPTYCH_EVERY_DEVICE");
  return every != nullptr && *every != '\0';
}

}  // namespace triptych::test
