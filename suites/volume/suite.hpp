#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// Creates the suite for volume raycasting. Files named by factors are searched for in
// `data_folders`.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders);

}  // namespace triptych::volume_suite
