#pragma once
// The properties of the processor on which a driver's generated code depends, for devices that
// compute on the processor.

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// The instruction-set flags of this processor that compilers of device code use, sorted and
// separated by spaces: "avx avx2 avx512f fma …". Empty if /proc/cpuinfo does not contain them.
[[nodiscard]] std::string cpu_features();

// The named environment variables that are set, with their values.
[[nodiscard]] std::map<std::string, std::string> set_variables(
    std::span<const std::string_view> names);

}  // namespace triptych::measure
