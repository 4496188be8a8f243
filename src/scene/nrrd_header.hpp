#pragma once
// The fields of an NRRD header. nrrd.cpp interprets them.

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace triptych::scene::nrrd {

struct Field {
  std::string value;
  core::FilePlace place;
};

// The fields of a header, by their canonical names.
class Header {
 public:
  // Reads a header. Throws InputError with the line number if the header is not supported or if a
  // field appears twice, and IoError if the file cannot be read.
  explicit Header(const std::filesystem::path& file);

  [[nodiscard]] const Field* find(const std::string& name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Field& require(const std::string& name) const {
    const Field* field = find(name);
    if (field == nullptr) {
      throw core::InputError({.file = file_}, fmt::format("the header has no field '{}'", name));
    }
    return *field;
  }
  // Returns the position (in the decompressed bytes) after the blank line that ends the header, or
  // nullopt if there is no such line.
  [[nodiscard]] std::optional<std::uint64_t> data_start() const noexcept { return data_start_; }
  // Returns the lines after "data file: LIST".
  [[nodiscard]] const std::vector<Field>& listed_files() const noexcept { return files_; }
  [[nodiscard]] core::FilePlace last_line() const { return {.file = file_, .line = lines_}; }

 private:
  void parse(std::string_view start);
  void add(std::string_view line, const core::FilePlace& place);

  std::string file_;
  std::map<std::string, Field> fields_;
  std::optional<std::uint64_t> data_start_;
  std::vector<Field> files_;
  bool lists_files_ = false;
  int lines_ = 0;
};

}  // namespace triptych::scene::nrrd
