#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::particles_suite {

// Spheres by sprites and by compute. `data_folders` are where files named in the factors are looked
// for.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    std::vector<std::filesystem::path> data_folders);

}  // namespace triptych::particles_suite
