#pragma once
#include <filesystem>

namespace triptych::core {

// A folder of its own among the system's temporary ones, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();  // throws IoError when none can be made
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace triptych::core
