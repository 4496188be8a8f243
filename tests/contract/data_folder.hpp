#pragma once
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace triptych::contract {

// The real volumes in $TRIPTYCH_DATA/volumes, sorted; none when the variable is not set.
inline std::vector<std::filesystem::path> real_volumes() {
  std::vector<std::filesystem::path> files;
  const char* root = std::getenv("TRIPTYCH_DATA");
  if (root == nullptr) return files;
  const std::filesystem::path folder = std::filesystem::path(root) / "volumes";
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".nrrd") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace triptych::contract
