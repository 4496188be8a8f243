#pragma once
// The future content of a folder of baselines, and what changes in it.

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
  std::filesystem::path folder;    // the folder as it is now
  Files files;                     // the files as they will be
  std::vector<std::string> lines;  // the changes, one a line

  void drop_folder(std::string_view start) {
    std::erase_if(files, [&](const auto& file) { return file.first.starts_with(start); });
  }
};

// Changes one file of the folder, beginning with its content so far.
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
  // Writes the file into the NextFolder if anything changed, and adds a line for each change.
  // `depth` is that of to_lines.
  void write(int depth) const;

 private:
  void describe() const;

  NextFolder& next_;
  std::string name_;
  core::Json before_;
  core::Json after_;
};

}  // namespace triptych::judge
