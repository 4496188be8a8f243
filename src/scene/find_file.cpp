#include "scene/find_file.hpp"

#include <system_error>

namespace triptych::scene {

std::optional<std::filesystem::path> find_file(std::string_view name,
                                               const std::vector<std::filesystem::path>& folders) {
  const std::filesystem::path file(name);
  std::error_code unreadable;  // a file whose status cannot be read counts as missing
  if (std::filesystem::is_regular_file(file, unreadable)) return file;
  if (file.empty() || file.is_absolute()) return std::nullopt;
  for (const auto& folder : folders) {
    if (std::filesystem::is_regular_file(folder / file, unreadable)) return folder / file;
  }
  return std::nullopt;
}

}  // namespace triptych::scene
