#pragma once
// Replaces a folder of baselines as a whole.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace triptych::judge {

// The contents of the files, by their paths relative to the folder.
using Files = std::map<std::string, std::vector<std::byte>>;

// The lock that a process holds while it writes below `root`. The constructor creates `root` if it
// is missing, and throws IoError if another process holds the lock.
class WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& root);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int fd_;
};

// Replaces the content of the folder with these files. The files are written to a folder next to it
// (Layout::staging_folder) and flushed to the disk. Then the two folders are exchanged atomically,
// so a process that is killed before this step changes nothing. If the file system cannot exchange
// folders, the files are written one by one, the manifest last; the checksums in the manifest
// reveal whether a process was killed before it finished. See AcceptRequest for `on_written`.
// Throws IoError.
void replace_folder(const std::filesystem::path& folder, const Files& files,
                    const std::function<void(const std::string&)>& on_written);

}  // namespace triptych::judge
