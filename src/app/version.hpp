#pragma once
#include <string>

namespace triptych::app {

// "0.1.0, commit 0123456789ab"; with "+" where the sources were not as committed, without the
// commit where they were no checkout.
[[nodiscard]] std::string version();

}  // namespace triptych::app
