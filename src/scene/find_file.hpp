#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::scene {

// The file with this name or, if the name is relative, the first file with this name below
// `folders`.
[[nodiscard]] std::optional<std::filesystem::path> find_file(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

}  // namespace triptych::scene
