#pragma once
#include <string>

namespace triptych::app {

// "0.1.0, commit 0123456789ab, device code 0123456789ab"; with "+" if the sources differed from the
// commit, and without the commit if they were not a git checkout. "device code" is a hash of all
// kernels and shaders in the program, so that a difference in them can be distinguished from one in
// the rest.
[[nodiscard]] std::string version();

}  // namespace triptych::app
