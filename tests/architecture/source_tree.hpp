#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace triptych::architecture {

inline const std::filesystem::path source_folder = TRIPTYCH_SOURCE_FOLDER;

// Returns the files below `folder` in the source tree whose names end in one of `endings`, sorted.
inline std::vector<std::filesystem::path> files_below(const std::string& folder,
                                                      const std::vector<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  const auto root = source_folder / folder;
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    const bool wanted = std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
      return name.ends_with(ending);
    });
    if (entry.is_regular_file() && wanted) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::string read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Returns the names of the backends that draw with a real API: all folders in backends/ except the
// folder of the null backend.
inline std::vector<std::string> apis_of_backends() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder / "backends")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name != "null") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Returns the paths of all #include directives of a file.
inline std::vector<std::string> includes_of(const std::filesystem::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])", std::regex::multiline);
  const std::string text = read(file);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

}  // namespace triptych::architecture
