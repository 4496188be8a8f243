#pragma once
#include <filesystem>

namespace triptych::core {

// A new folder in the system's folder for temporary files. The destructor removes it with its
// content.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws IoError if the folder cannot be created
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace triptych::core
