#pragma once
#include <string>
#include <string_view>

namespace triptych::technique {

// The text of a shared device source by its file name, such as "raycast.glsl" or "volume_math.h",
// for APIs that compile at run time. Throws std::out_of_range for an unknown name.
[[nodiscard]] std::string_view source(std::string_view name);

// The same text with every line `#include "PATH"` replaced by the text of that source. It is for
// compilers without #include. For Vulkan, glslang resolves includes itself.
[[nodiscard]] std::string whole_source(std::string_view name);

}  // namespace triptych::technique
