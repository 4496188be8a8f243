#pragma once
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// Returns the suite's factors, with their levels and defaults.
[[nodiscard]] const std::vector<measure::Factor>& volume_factors();

// Checks a level of a factor whose kind does not define which levels are valid, such as camera,
// data, transfer function or viewport. Throws InputError, with the expected syntax, if the level is
// invalid.
void check_value(const measure::Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders);

// The level of `budget` that sets no limit.
inline constexpr std::string_view no_budget = "none";

// The field of view for volumes in the paper (docs/paper.md), in degrees.
inline constexpr double field_of_view = 90;

}  // namespace triptych::volume_suite
