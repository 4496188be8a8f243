#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triptych::scene {

// Returns the file with this name. A relative name is first looked up in the working directory, and
// then in each of `folders`. Returns nullopt if there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> find_file(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

// Returns a sentence part that explains why a data set cannot be loaded: its file was not found in
// the working directory or in `folders`. It names a file with a similar name if there is one.
// Otherwise it names the folder `subfolder` of TRIPTYCH_DATA, where the file should be. `data` is
// the data set as the user wrote it, and `file` is the name of its file.
[[nodiscard]] std::string not_found_text(std::string_view data, std::string_view file,
                                         const std::vector<std::filesystem::path>& folders,
                                         std::string_view subfolder);

}  // namespace triptych::scene
