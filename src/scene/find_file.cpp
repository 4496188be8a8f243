#include "scene/find_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/nearest_name.hpp"
#include "scene/text_lines.hpp"

namespace triptych::scene {
namespace {

// Adds the names of the files in a folder. Large folders are read only in part, because this
// function is only used for a message.
void add_file_names(const std::filesystem::path& folder, std::vector<std::string>& names) {
  constexpr int most_entries = 10000;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (int i = 0; i < most_entries && !error && entry != std::filesystem::directory_iterator();
       ++i) {
    std::error_code unreadable;
    if (entry->is_regular_file(unreadable)) names.push_back(entry->path().filename().string());
    entry.increment(error);
  }
}

// Returns the file whose name is most similar to the name of a missing file, in a folder in which
// find_file() would find it.
std::optional<std::string> similar_file(const std::filesystem::path& file,
                                        const std::vector<std::filesystem::path>& folders) {
  const std::filesystem::path parent = file.parent_path();
  std::vector<std::string> names;
  add_file_names(parent.empty() ? "." : parent, names);
  if (!file.is_absolute()) {
    for (const auto& folder : folders) add_file_names(folder / parent, names);
  }
  std::ranges::sort(names);  // so that the result does not depend on the order in the folder
  const auto nearest = core::nearest_name(file.filename().string(), names);
  if (!nearest) return std::nullopt;
  return (parent / *nearest).string();
}

}  // namespace

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

std::string not_found_text(std::string_view data, std::string_view file,
                           const std::vector<std::filesystem::path>& folders,
                           std::string_view subfolder) {
  std::string text = fmt::format(
      "data file '{}' was not found{}", data,
      folders.empty() ? ""
                      : fmt::format(" in the current folder or in {}", folders.front().string()));
  if (const auto similar = similar_file(file, folders)) {
    return text + fmt::format("; did you mean '{}'?", *similar);
  }
  return text + fmt::format("; set TRIPTYCH_DATA to the folder that contains {}/", subfolder);
}

}  // namespace triptych::scene
