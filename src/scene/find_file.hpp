#pragma once
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace triptych::scene {

// A file as named, or, when the name is relative, the first of that name below `folders`.
[[nodiscard]] std::optional<std::filesystem::path> find_file(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

}  // namespace triptych::scene
