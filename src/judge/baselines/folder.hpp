#pragma once
// Replaces a folder of baselines as a whole.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace triptych::judge {

// Contents by the names within the folder.
using Files = std::map<std::string, std::vector<std::byte>>;

// Held by the process that writes below `root`, which is created if it is missing. The constructor
// throws IoError if another process already holds it.
class WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& root);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int fd_;
};

// Replaces the content of the folder by these files. They are written into a folder next to it
// (Layout::aside) and flushed to the disk. Then the two folders are exchanged atomically, so a
// process that is killed before has changed nothing. If the file system cannot exchange folders,
// the files are renamed one by one, the manifest last: it shows whether a process was killed in
// between. `on_written` is that of AcceptRequest. Throws IoError.
void replace_folder(const std::filesystem::path& folder, const Files& files,
                    const std::function<void(const std::string&)>& on_written);

}  // namespace triptych::judge
