#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::particles_suite {

// The suite for spheres, drawn as sprites or by compute. Files named by factors are looked for in
// `data_folders`.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders);

}  // namespace triptych::particles_suite
