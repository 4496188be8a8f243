#pragma once
// A folder of baselines as it will be, and what changes in it.

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
  std::filesystem::path folder;    // as it is now
  Files files;                     // as they will be
  std::vector<std::string> lines;  // what changes

  void drop_folder(std::string_view start) {
    std::erase_if(files, [&](const auto& file) { return file.first.starts_with(start); });
  }
};

// Of one of its files, as it will be so far.
class Update {
 public:
  // `next` has to live as long.
  Update(NextFolder& next, std::string name);

  core::Json& value() { return after_; }
  core::Json& object() {
    if (!after_.is_object()) after_ = core::Json::object();
    return after_;
  }
  // Where anything changed; says what. `depth` as of to_lines.
  void write(int depth) const;

 private:
  void describe() const;

  NextFolder& next_;
  std::string name_;
  core::Json before_;
  core::Json after_;
};

}  // namespace triptych::judge
