#pragma once
// A folder of baselines, replaced as a whole.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace triptych::judge {

using Files = std::map<std::string, std::vector<std::byte>>;  // content by name within the folder

// Held by whoever writes below `root`, which is made if it is missing. The constructor throws
// IoError where somebody else holds it.
class WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& root);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int fd_;
};

// Afterwards the folder holds these files and no others. They are written beside it
// (Layout::aside), brought to the disk, and the two folders change places, so that whoever is
// killed has changed nothing. Where a file system cannot exchange folders they are renamed one by
// one, the manifest last: a kill in between is told by it. `on_written` as in AcceptRequest. Throws
// IoError.
void replace_folder(const std::filesystem::path& folder, const Files& files,
                    const std::function<void(const std::string&)>& on_written);

}  // namespace triptych::judge
