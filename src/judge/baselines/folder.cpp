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
void act_on(const fs::path& path, const Act& act) {
  try {
    act();
  } catch (const fs::filesystem_error& error) {
    throw core::IoError(fmt::format("{}: {}", path.string(), error.code().message()));
  }
}

// Flushes a file or folder to the disk.
void flush(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int failed = fd < 0 || ::fsync(fd) != 0 ? errno : 0;
  if (fd >= 0) ::close(fd);
  // The error EINVAL is ignored, because some file systems cannot flush a folder.
  if (failed != 0 && failed != EINVAL) {
    throw core::IoError(
        fmt::format("{}: {}", path.string(), std::generic_category().message(failed)));
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

bool exchange(const fs::path& one, const fs::path& other) {
  return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

void replace_one_by_one(const fs::path& folder, const Files& files) {
  for (const auto& [name, content] : files) {
    if (name == Layout::manifest) continue;
    fs::create_directories((folder / name).parent_path());
    core::write_file(content, folder / name);
  }
  std::vector<fs::path> others;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && !files.contains(name)) others.push_back(entry.path());
  }
  for (const fs::path& file : others) fs::remove(file);
  core::write_file(files.at(Layout::manifest), folder / Layout::manifest);
}

}  // namespace

WriterLock::WriterLock(const fs::path& root) : fd_(-1) {
  act_on(root, [&] { fs::create_directories(root); });
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
  const fs::path aside = Layout::aside(folder);
  act_on(aside, [&] {
    fs::remove_all(aside);  // may be left over from a process that was killed
    fs::create_directories(aside);
    write_files(aside, files, on_written);
    if (on_written) on_written({});
    if (!fs::exists(folder)) {
      fs::rename(aside, folder);
    } else if (!exchange(aside, folder)) {
      replace_one_by_one(folder, files);
    }
    flush(folder.parent_path());
    fs::remove_all(aside);
  });
}

}  // namespace triptych::judge
