#pragma once
// Simpler levels of a factor.

#include <string>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::reduction {

// Levels that are simpler than the given one, the simplest first; empty if there are none. Taking
// one of them repeatedly always ends.
//   a choice           the levels before it, because suites list the simplest first
//   a number           0 if that means off, then the default
//   viewport and data  smaller sizes: all sides, then one; for data without a size, the default
//   another text       the default
// The factor may not accept all of them; Suite::check decides.
[[nodiscard]] std::vector<std::string> plainer(const measure::Factor& factor,
                                               const std::string& level);

}  // namespace triptych::reduction
