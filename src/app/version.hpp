#pragma once
#include <string>

namespace triptych::app {

// Returns, for example, "0.1.0, commit 0123456789ab, device code 0123456789ab". The commit ends
// with "+" if the sources had local changes, and is left out if they were not a git checkout.
// "device code" is a hash of all kernels and shaders in the program. It shows whether two builds
// differ in their device code or only in host code.
[[nodiscard]] std::string version();

}  // namespace triptych::app
