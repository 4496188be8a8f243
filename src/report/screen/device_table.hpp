#pragma once
// The table of `compare --apis`: the cost of each technique on each device.

#include <string>

#include "comparison/side_by_side.hpp"

namespace triptych::report {

[[nodiscard]] std::string screen_of(const comparison::SideBySide& table);

}  // namespace triptych::report
