#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::particles_suite {

// The factors of the suite with their levels and defaults.
[[nodiscard]] const std::vector<measure::Factor>& particle_factors();

// Checks the values of factors whose kind does not define what is valid: camera, data, transfer
// function, viewport. Throws InputError with what was expected.
void check_value(const measure::Factor& factor, std::string_view value,
                 const std::vector<std::filesystem::path>& folders);

}  // namespace triptych::particles_suite
