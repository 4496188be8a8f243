#pragma once
#include <string>

namespace triptych::app {

// "0.1.0, commit 0123456789ab"; with "+" if the sources differed from the commit, and without the
// commit if they were not a git checkout.
[[nodiscard]] std::string version();

}  // namespace triptych::app
