#pragma once
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace triptych::contract {

// Returns the files in $TRIPTYCH_DATA/NAME, sorted; empty if the variable is not set.
inline std::vector<std::filesystem::path> real_files(const char* name) {
  std::vector<std::filesystem::path> files;
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr) return files;
  const std::filesystem::path folder = std::filesystem::path(root) / name;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

inline std::vector<std::filesystem::path> real_volumes() {
  std::vector<std::filesystem::path> files = real_files("volumes");
  std::erase_if(files, [](const auto& file) { return file.extension() != ".nrrd"; });
  return files;
}

inline std::vector<std::filesystem::path> real_particles() {
  return real_files("particles");
}

}  // namespace triptych::contract
