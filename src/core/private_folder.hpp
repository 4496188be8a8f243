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
  // Makes root and root/names[0]/names[1]/… where they are missing, with mode 0700. Throws IoError
  // that names the folder and the reason
  // - where one below `root` is a symbolic link or no folder, belongs to another user, or can be
  //   written by other users, who may have put something there. One that others can only read is
  //   closed to them.
  // - where other users can rename what is in `root`: it can be written by them and is not sticky.
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

// "triptych-UID" in the folder for temporary files, with the folder `name` in it: for files that
// have to outlive the process.
[[nodiscard]] PrivateFolder private_temporary_folder(const std::string& name);
// The first part of that path: a name that is unique to this user.
[[nodiscard]] std::string name_of_this_user();

}  // namespace triptych::core
