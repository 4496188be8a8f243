#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::particles_suite {

// Creates the suite for spheres, which are drawn as sprites or by compute. Files named by factors
// are searched for in `data_folders`.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders);

}  // namespace triptych::particles_suite
