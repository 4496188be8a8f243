#include "judge/baselines/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/error.hpp"
#include "core/file.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace fs = std::filesystem;
namespace {

// Converts file-system errors to core::IoError.
template <typename Act>
void with_io_errors(const fs::path& path, const Act& act) {
  try {
    act();
  } catch (const fs::filesystem_error& error) {
    throw core::IoError(fmt::format("{}: {}", path.string(), error.code().message()));
  }
}

// Flushes a file or folder to the disk.
void flush(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int error_code = fd < 0 || ::fsync(fd) != 0 ? errno : 0;
  if (fd >= 0) ::close(fd);
  // The error EINVAL is ignored, because some file systems cannot flush a folder.
  if (error_code != 0 && error_code != EINVAL) {
    throw core::IoError(
        fmt::format("{}: {}", path.string(), std::generic_category().message(error_code)));
  }
}

void write_files(const fs::path& folder, const Files& files,
                 const std::function<void(const std::string&)>& on_written) {
  for (const auto& [name, content] : files) {
    fs::create_directories((folder / name).parent_path());
    core::write_file(content, folder / name);
    flush(folder / name);
    if (on_written) on_written(name);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) flush(entry.path());
  }
  flush(folder);
}

bool exchange_folders(const fs::path& a, const fs::path& b) {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

void replace_file_by_file(const fs::path& folder, const Files& files) {
  for (const auto& [name, content] : files) {
    if (name == Layout::manifest) continue;
    fs::create_directories((folder / name).parent_path());
    core::write_file(content, folder / name);
  }
  std::vector<fs::path> obsolete;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && !files.contains(name)) obsolete.push_back(entry.path());
  }
  for (const fs::path& file : obsolete) fs::remove(file);
  core::write_file(files.at(Layout::manifest), folder / Layout::manifest);
}

}  // namespace

WriterLock::WriterLock(const fs::path& root) : fd_(-1) {
  with_io_errors(root, [&] { fs::create_directories(root); });
  fd_ = ::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // Any other error means that this folder cannot be locked at all, so no other process has locked
  // it either.
  if (fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(fd_);
    throw core::IoError(
        fmt::format("{}: another `triptych accept` is writing to this folder", root.string()));
  }
}

WriterLock::~WriterLock() {
  if (fd_ >= 0) ::close(fd_);
}

void replace_folder(const fs::path& folder, const Files& files,
                    const std::function<void(const std::string&)>& on_written) {
  const fs::path staging = Layout::staging_folder(folder);
  with_io_errors(staging, [&] {
    fs::remove_all(staging);  // may be left over from a process that was killed
    fs::create_directories(staging);
    write_files(staging, files, on_written);
    if (on_written) on_written({});
    if (!fs::exists(folder)) {
      fs::rename(staging, folder);
    } else if (!exchange_folders(staging, folder)) {
      replace_file_by_file(folder, files);
    }
    flush(folder.parent_path());
    fs::remove_all(staging);
  });
}

}  // namespace triptych::judge
