#pragma once
// Default locations of data and baselines.

#include <filesystem>
#include <vector>

namespace triptych::app {

// Returns the folders that are searched for data files: $TRIPTYCH_DATA and its subfolders volumes/
// and particles/.
[[nodiscard]] std::vector<std::filesystem::path> data_folders();

// Returns the baselines folder: ./baselines if it exists, otherwise the folder installed with the
// program, otherwise the folder in the source tree.
[[nodiscard]] std::filesystem::path default_baselines();

}  // namespace triptych::app
