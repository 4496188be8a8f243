#pragma once
// Folders that only the current user can access, for compiled code and similar files. In a folder
// that everybody can write to, such as /tmp, another user could otherwise create a folder with the
// expected name first and fill it with malicious code.

#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace triptych::core {

// A folder below `root` that belongs to the current user and that no other user can access. It
// stays open, so files can still be opened relative to it if the folder is renamed.
class PrivateFolder {
 public:
  // Creates `root` and root/names[0]/names[1]/… with mode 0700 if they are missing. If other users
  // can read a folder below `root`, the constructor removes their permission. It throws an IoError
  // that states the folder and the reason if a system call fails, and in two other cases:
  // - A folder below `root` is a symbolic link or not a folder, belongs to another user, or can be
  //   written by other users, so that its content cannot be trusted.
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

// Returns the folder "triptych-UID/NAME" in the system's folder for temporary files, where UID is
// the user id and NAME is `name`. The folder is used for files that must outlive the process.
[[nodiscard]] PrivateFolder private_temporary_folder(const std::string& name);
// Returns "triptych-UID", the folder name that is unique to the current user.
[[nodiscard]] std::string name_of_this_user();

}  // namespace triptych::core
