#pragma once
// Where things are unless somebody says otherwise.

#include <filesystem>
#include <vector>

namespace triptych::app {

// Folders in which data files are looked for: $TRIPTYCH_DATA and its volumes/ and particles/.
[[nodiscard]] std::vector<std::filesystem::path> data_folders();

// Of baselines: ./baselines if it is there, else those installed with the program, else those of
// the source tree.
[[nodiscard]] std::filesystem::path default_baselines();

}  // namespace triptych::app
