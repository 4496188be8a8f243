#pragma once
// What a plan says about factors, in one spelling: for load_plan and what lies beside it.

#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/plan/plan_yaml.hpp"

namespace triptych::measure {

// "; did you mean 'step'?", or all there are where nothing is near.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& known);

// The default in the same spelling as values from a plan.
[[nodiscard]] std::string standard_of(const Factor& factor);

// Whether "auto" is among the values, and stands for several of the factor's levels.
[[nodiscard]] bool is_automatic(const Factor& factor, const std::vector<PlacedText>& given);

// Each value in its one spelling; of a factor of texts "PATH:*/n" stands for n of them, PATH:0/n to
// PATH:(n−1)/n, and "auto" of a factor for its automatic levels. Throws InputError with the place
// of a value that is no number, out of range, no level, refused by the suite, or there twice.
[[nodiscard]] std::vector<std::string> canonical_values(const Suite& suite, const Factor& factor,
                                                        const std::vector<PlacedText>& given);

}  // namespace triptych::measure
