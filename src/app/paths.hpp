#pragma once
// Default locations of data and baselines.

#include <filesystem>
#include <vector>

namespace triptych::app {

// The folders in which data files are searched: $TRIPTYCH_DATA and its subfolders volumes/ and
// particles/.
[[nodiscard]] std::vector<std::filesystem::path> data_folders();

// The folder of the baselines: ./baselines if it exists, else those installed with the program,
// else those of the source tree.
[[nodiscard]] std::filesystem::path default_baselines();

}  // namespace triptych::app
