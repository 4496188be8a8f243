#pragma once
#include <string>
#include <string_view>

namespace triptych::technique {

// Text of a shared device source by its file name, such as "raycast.glsl" or "volume_math.h", for
// the APIs that compile at run time. Throws std::out_of_range for a name there is not.
[[nodiscard]] std::string_view source(std::string_view name);

// The same with every line `#include "PATH"` replaced by the text of that source, as glslang does
// where it compiles shaders for Vulkan: for compilers that know no such line.
[[nodiscard]] std::string whole_source(std::string_view name);

}  // namespace triptych::technique
