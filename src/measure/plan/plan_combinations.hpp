#pragma once
// All combinations of factors' values, in the order in which they are measured.

#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::measure {

// What a plan gives, each in its one spelling; a factor left out has its default.
using ValuesByFactor = std::map<std::string, std::vector<std::string>>;

// The suite's factors; those before vary more slowly.
[[nodiscard]] std::vector<const Factor*> slowest_first(const Suite& suite);

// Throws InputError at `place` where there are too many.
[[nodiscard]] std::vector<Configuration> all_combinations(const Suite& suite,
                                                          const ValuesByFactor& values,
                                                          const core::FilePlace& place);

// Adds the combinations that are not there yet, beside others of the same data.
void add_combinations(const std::vector<Configuration>& more,
                      std::vector<Configuration>& configurations);

}  // namespace triptych::measure
