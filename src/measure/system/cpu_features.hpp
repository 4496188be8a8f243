#pragma once
// Properties of this machine that affect the code that CPU drivers generate.

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// Returns the processor's instruction-set flags that device-code compilers use, sorted and
// separated by spaces: "avx avx2 avx512f fma …". Empty if /proc/cpuinfo does not contain them.
[[nodiscard]] std::string cpu_features();

// Returns those of the named environment variables that are set, with their values.
[[nodiscard]] std::map<std::string, std::string> set_variables(
    std::span<const std::string_view> names);

}  // namespace triptych::measure
