#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::scene {

// Returns the file with this name. A relative name is first looked up in the working directory, and
// then in each of `folders`. Returns nullopt if there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> find_file(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

}  // namespace triptych::scene
