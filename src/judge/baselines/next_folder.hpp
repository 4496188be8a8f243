#pragma once
// The new content of a baselines folder before it is written, and a description of the changes.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "judge/baselines/folder.hpp"

namespace triptych::judge {

[[nodiscard]] std::vector<std::byte> bytes_of(std::string_view text);

struct NextFolder {
  std::filesystem::path folder;    // the existing folder
  Files files;                     // the new files
  std::vector<std::string> lines;  // the changes, one per line

  void drop_folder(std::string_view prefix) {
    std::erase_if(files, [&](const auto& file) { return file.first.starts_with(prefix); });
  }
};

// Edits one JSON file of the folder, starting with its current content.
class Update {
 public:
  // `next` must live as long as this object.
  Update(NextFolder& next, std::string name);

  core::Json& value() { return after_; }
  [[nodiscard]] const core::Json& value() const { return after_; }
  core::Json& object() {
    if (!after_.is_object()) after_ = core::Json::object();
    return after_;
  }
  // Stores the file in the NextFolder if anything changed, and describes the changes. `depth` is
  // passed to core::to_lines.
  void write(int depth) const;

 private:
  void describe() const;

  NextFolder& next_;
  std::string name_;
  core::Json before_;
  core::Json after_;
};

}  // namespace triptych::judge
