#pragma once
// The change that TRIPTYCH_LAYER requests: one limit with its value, or one fault.

#include <cstdint>
#include <string>
#include <string_view>

namespace triptych::layer {

struct Change {
  std::string name;
  double value = 0;  // 0 if no value was given
};

// Returns the change, parsed from TRIPTYCH_LAYER, which has the form `name` or `name=value`.
[[nodiscard]] const Change& change();

[[nodiscard]] bool asked(std::string_view name);
[[nodiscard]] std::uint32_t asked_number();

}  // namespace triptych::layer
