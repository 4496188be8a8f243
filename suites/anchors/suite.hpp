#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "measure/suite.hpp"

namespace triptych::anchors_suite {

// Frozen work that measures the device and not the program: technique and size. Needs no data; has
// no pictures, so that truth(), truth_key() and describe() throw core::NotSupported.
[[nodiscard]] std::unique_ptr<measure::SuiteWithTruth> make_suite(
    const std::vector<std::filesystem::path>& data_folders);

}  // namespace triptych::anchors_suite
