#pragma once
// What decides, on a device that is the processor, which code a driver generates.

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::measure {

// The instruction-set flags of this processor that compilers of device code make use of, sorted, by
// spaces: "avx avx2 avx512f fma …". Empty where /proc/cpuinfo does not tell.
[[nodiscard]] std::string cpu_features();

// Those of the named environment variables that are set, with their values.
[[nodiscard]] std::map<std::string, std::string> set_variables(
    std::span<const std::string_view> names);

}  // namespace triptych::measure
