#pragma once
// Finds simpler levels of a factor.

#include <string>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::reduction {

// Returns levels that are simpler than `level`, with the simplest level first, or an empty list if
// there are none. Replacing a level with one of them cannot go on forever. The simpler levels are,
// for
//   a choice           the levels before it, because suites list the simplest level first
//   a number           0 if the factor allows it, because 0 usually turns something off, then the
//   default viewport and data  smaller sizes, first along all axes and then along one axis; for
//   data without a
//                      size, the default
//   any other text     the default
// The factor may not accept all of these levels. Suite::check decides which are valid.
[[nodiscard]] std::vector<std::string> plainer(const measure::Factor& factor,
                                               const std::string& level);

}  // namespace triptych::reduction
