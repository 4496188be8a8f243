#pragma once
#include <string>
#include <string_view>

namespace triptych::technique {

// Returns the source code of a file shared by the backends, such as "raycast.glsl" or
// "volume_math.h", for APIs that compile at run time. Throws std::out_of_range if the name is
// unknown.
[[nodiscard]] std::string_view source(std::string_view name);

// Like source(), but replaces every line `#include "PATH"` by the source code of PATH, for
// compilers without #include. For Vulkan, glslang resolves includes itself.
[[nodiscard]] std::string whole_source(std::string_view name);

}  // namespace triptych::technique
