#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::volume_suite {

// Volume raycasting. `data_folders` are where files named in the factors are looked for.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders);

}  // namespace triptych::volume_suite
