#pragma once
// Finds simpler levels of a factor.

#include <string>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::reduction {

// Returns levels that are simpler than `level`, simplest first, or an empty list if there are none.
// Repeatedly replacing a level with a simpler level always terminates. The simpler levels are:
//   for a choice              the levels before it, because suites list the simplest level first
//   for a number              0 if the factor allows it, because 0 usually turns something off;
//                             then the default
//   for `viewport` or `data`  smaller sizes, first along all axes and then along one axis; the
//                             default if the data has no size
//   for any other factor      the default
// The factor may not accept all of these levels. Suite::check() decides which are valid.
[[nodiscard]] std::vector<std::string> simpler_levels(const measure::Factor& factor,
                                                      const std::string& level);

}  // namespace triptych::reduction
