#pragma once
// Folders that only this user can access, for compiled code and similar files. In a folder that
// everybody can write to, such as /tmp, another user could otherwise create a folder with the
// expected name first and fill it with malicious code.

#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace triptych::core {

// A folder below `root` that this user made and only this user can enter. It stays open, so that
// files can be opened relative to it, whatever happens to its name.
class PrivateFolder {
 public:
  // Creates root and root/names[0]/names[1]/… where they are missing, with mode 0700. Throws
  // IoError that names the folder and the reason in two cases:
  // - A folder below `root` is a symbolic link or not a folder, belongs to another user, or can be
  //   written by other users, who may have put something there. If others can only read it, the
  //   constructor removes their permission instead.
  // - Other users can rename the content of `root`, because they can write to it and it has no
  //   sticky bit.
  PrivateFolder(const std::filesystem::path& root, std::span<const std::string> names);
  PrivateFolder(PrivateFolder&& other) noexcept
      : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] int fd() const noexcept { return fd_; }

 private:
  std::filesystem::path path_;
  int fd_ = -1;
};

// The folder "triptych-UID/NAME" in the system's folder for temporary files, where NAME is `name`.
// It is for files that must outlive the process.
[[nodiscard]] PrivateFolder private_temporary_folder(const std::string& name);
// The first part of that path: a name that is unique to this user.
[[nodiscard]] std::string name_of_this_user();

}  // namespace triptych::core
