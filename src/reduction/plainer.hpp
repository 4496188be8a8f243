#pragma once
// What is plainer than a level of a factor.

#include <string>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::reduction {

// Levels that are plainer, the plainest first; none where there are none. Whoever takes one of them
// again and again comes to an end.
//   a choice           those before it: suites list their levels from the plainest on
//   a number           0 where that means off, then the default
//   viewport and data  smaller sizes: all sides, then one; of data without a size, the default
//   another text       the default
// They may not all be levels that the factor takes: Suite::check says.
[[nodiscard]] std::vector<std::string> plainer(const measure::Factor& factor,
                                               const std::string& level);

}  // namespace triptych::reduction
