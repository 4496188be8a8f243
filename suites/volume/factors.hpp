#pragma once
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// The factors of the suite with their levels and defaults.
[[nodiscard]] const std::vector<measure::Factor>& volume_factors();

// Checks the values of factors whose kind does not define what is valid: camera, data, transfer
// function, viewport. Throws InputError with what was expected.
void check_value(const measure::Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders);

// The level of `budget` that sets no limit.
inline constexpr std::string_view no_budget = "none";

// The paper's field of view for volumes, in degrees.
inline constexpr double field_of_view = 90;

}  // namespace triptych::volume_suite
