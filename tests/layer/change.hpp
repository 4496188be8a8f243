#pragma once
// The request in TRIPTYCH_LAYER: one limit with its value, or one fault.

#include <cstdint>
#include <string>
#include <string_view>

namespace triptych::layer {

struct Change {
  std::string name;
  double value = 0;  // 0 if none was given
};

// Parsed from `name` or `name=value` in TRIPTYCH_LAYER.
[[nodiscard]] const Change& change();

[[nodiscard]] bool asked(std::string_view name);
[[nodiscard]] std::uint32_t asked_number();

}  // namespace triptych::layer
