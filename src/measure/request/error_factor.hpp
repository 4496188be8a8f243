#pragma once

#include <string_view>

#include "measure/contract/suite.hpp"

namespace triptych::measure {

// Returns one of the suite's error_factors. Throws InputError if the suite has no such factor.
[[nodiscard]] const Factor& error_factor(const Suite& suite, std::string_view name);

}  // namespace triptych::measure
