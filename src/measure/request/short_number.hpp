#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace triptych::measure {

// Returns the number, rounded down to 9 significant bits, so that the numbers in plans are short.
[[nodiscard]] inline std::string short_number(double value) {
  const double unit = std::exp2(std::floor(std::log2(value)) - 8);
  return fmt::format("{}", std::floor(value / unit) * unit);
}

}  // namespace triptych::measure
