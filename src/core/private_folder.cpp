#include "core/private_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "core/error.hpp"

namespace triptych::core {
namespace fs = std::filesystem;
namespace {

constexpr mode_t owner_only = 0700;
constexpr mode_t others_write = S_IWGRP | S_IWOTH;

[[noreturn]] void reject(const fs::path& folder, std::string_view reason) {
  throw IoError(fmt::format("{}: {}", folder.string(), reason));
}

[[noreturn]] void reject(const fs::path& folder, int error) {
  reject(folder, std::generic_category().message(error));
}

class FolderDescriptor {
 public:
  explicit FolderDescriptor(int fd) : fd_(fd) {}
  ~FolderDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FolderDescriptor(const FolderDescriptor&) = delete;
  FolderDescriptor& operator=(const FolderDescriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] int release() { return std::exchange(fd_, -1); }
  void replace(int fd) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }

 private:
  int fd_;
};

struct stat status_of(int fd, const fs::path& folder) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) reject(folder, errno);
  return status;
}

void create_folders(const fs::path& folder) {
  fs::path current;
  for (const fs::path& part : folder) {
    current /= part;
    if (::mkdir(current.c_str(), owner_only) != 0 && errno != EEXIST) reject(current, errno);
  }
}

int open_root(const fs::path& root) {
  std::error_code ignored;
  if (!fs::is_directory(root, ignored)) create_folders(root);
  FolderDescriptor fd(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() < 0) reject(root, errno);
  const struct stat status = status_of(fd.get(), root);
  if ((status.st_mode & others_write) != 0 && (status.st_mode & S_ISVTX) == 0) {
    reject(root,
           "other users can write to this folder, and because its sticky bit is not set, they can "
           "also rename the files in it");
  }
  return fd.release();
}

int open_within(int parent, const std::string& name, const fs::path& folder) {
  if (::mkdirat(parent, name.c_str(), owner_only) != 0 && errno != EEXIST) {
    reject(folder, errno);
  }
  FolderDescriptor fd(
      ::openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (fd.get() < 0) {
    if (errno == ELOOP || errno == ENOTDIR) reject(folder, "is a symbolic link or not a folder");
    reject(folder, errno);
  }
  const struct stat status = status_of(fd.get(), folder);
  if (status.st_uid != ::geteuid()) reject(folder, "belongs to another user");
  if ((status.st_mode & others_write) != 0) {
    reject(folder, "is writable by other users; remove this folder");
  }
  if ((status.st_mode & 0777) != owner_only && ::fchmod(fd.get(), owner_only) != 0) {
    reject(folder, errno);
  }
  return fd.release();
}

}  // namespace

PrivateFolder::PrivateFolder(const fs::path& root, std::span<const std::string> names)
    : path_(root) {
  FolderDescriptor folder(open_root(root));
  for (const std::string& name : names) {
    path_ /= name;
    folder.replace(open_within(folder.get(), name, path_));
  }
  fd_ = folder.release();
}

PrivateFolder::~PrivateFolder() {
  if (fd_ >= 0) ::close(fd_);
}

std::string name_of_this_user() {
  return fmt::format("triptych-{}", ::geteuid());
}

PrivateFolder private_temporary_folder(const std::string& name) {
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (error)
    throw IoError(fmt::format("cannot find the folder for temporary files: {}", error.message()));
  const std::array names{name_of_this_user(), name};
  return {temporary, names};
}

}  // namespace triptych::core
