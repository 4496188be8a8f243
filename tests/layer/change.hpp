#pragma once
// The request in TRIPTYCH_LAYER: limits with their values, or one fault.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::layer {

struct Change {
  std::string name;
  double value = 0;  // 0 if none was given
};

// Parsed from TRIPTYCH_LAYER, which is `name` or `name=value`, or several of these for limits,
// separated by ';'. Never empty.
[[nodiscard]] const std::vector<Change>& changes();
// The whole value of TRIPTYCH_LAYER.
[[nodiscard]] const std::string& requested();

[[nodiscard]] bool is_requested(std::string_view name);
// Returns the value of the requested change with this name; 0 if it has none.
[[nodiscard]] double requested_value(std::string_view name);
[[nodiscard]] std::uint32_t requested_number(std::string_view name);

}  // namespace triptych::layer
