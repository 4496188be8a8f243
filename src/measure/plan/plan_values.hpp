#pragma once
// Converts the values of factors in a plan to their canonical spelling, for load_plan() and related
// functions.

#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/plan/plan_yaml.hpp"

namespace triptych::measure {

// Returns "; did you mean 'step'?", or the list of all known names if none is similar.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& known);

// Returns the default of a factor in its canonical spelling.
[[nodiscard]] std::string default_of(const Factor& factor);

// Returns whether "auto" is among the values and stands for several levels of the factor.
[[nodiscard]] bool is_automatic(const Factor& factor, const std::vector<PlacedText>& given);

// Returns each value in its canonical spelling. In a text factor, "PATH:*/n" stands for n values,
// PATH:0/n to PATH:(n−1)/n. "auto" stands for the factor's automatic levels. Throws an InputError
// with the place of the value if a value is not a number, out of range, not a level, rejected by
// the suite, or duplicated.
[[nodiscard]] std::vector<std::string> canonical_values(const Suite& suite, const Factor& factor,
                                                        const std::vector<PlacedText>& given);

}  // namespace triptych::measure
