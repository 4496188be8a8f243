#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::particles_suite {

// Returns the suite's factors, with their levels and defaults.
[[nodiscard]] const std::vector<measure::Factor>& particle_factors();

// Checks a level of a factor whose kind does not define which levels are valid: camera, data,
// transfer function or viewport. Throws InputError, with the expected syntax, if the level is
// invalid.
void check_value(const measure::Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders);

}  // namespace triptych::particles_suite
