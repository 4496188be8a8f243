#pragma once
// Properties of this machine that affect the code that CPU drivers generate.

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// Returns the instruction-set flags of the CPU that affect generated device code, sorted and
// separated by spaces: "avx avx2 avx512f fma …". Returns an empty string if /proc/cpuinfo does not
// contain such flags.
[[nodiscard]] std::string cpu_features();

// Returns the names and values of those environment variables in `names` that are set.
[[nodiscard]] std::map<std::string, std::string> set_variables(
    std::span<const std::string_view> names);

}  // namespace triptych::measure
