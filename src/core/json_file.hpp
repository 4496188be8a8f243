#pragma once
// Reads and writes JSON files that people review and merge by hand. When the reader rejects a file,
// it reports the line of the error. The writer puts one value on each line.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.hpp"

namespace triptych::core {

class JsonFile;

// A value in a JsonFile. The JsonFile must outlive the node. If the value does not have the
// requested type, every accessor throws an InputError that states the file, the line and the path
// of the value in the file.
class JsonNode {
 public:
  JsonNode(const JsonFile& file, const Json& value, std::vector<std::string> path)
      : file_(&file), value_(&value), path_(std::move(path)) {}

  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members() const;
  [[nodiscard]] std::vector<JsonNode> elements() const;
  [[nodiscard]] JsonNode at(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const { return value_->contains(key); }
  [[nodiscard]] std::string text() const;
  [[nodiscard]] double positive_number() const;
  [[nodiscard]] double number_from_zero() const;  // not negative
  [[nodiscard]] std::uint64_t whole_number() const;
  [[nodiscard]] const Json& value() const noexcept { return *value_; }
  [[noreturn]] void fail(std::string_view message) const;

 private:
  [[nodiscard]] JsonNode child(std::string name, const Json& value) const;
  const JsonFile* file_;
  const Json* value_;
  std::vector<std::string> path_;
};

class JsonFile {
 public:
  // Returns nullopt if the file does not exist. Throws InputError with line and column if the file
  // is not JSON, or if an object has the same key twice, which can be the result of a careless
  // merge.
  [[nodiscard]] static std::optional<JsonFile> read(const std::filesystem::path& file);
  // Uses `text` as the content of the file, which need not exist.
  JsonFile(std::filesystem::path file, std::string text);

  [[nodiscard]] JsonNode root() const { return {*this, value_, {}}; }
  [[nodiscard]] const Json& value() const noexcept { return value_; }
  // Throws InputError with the line of the value at `path`, which consists of object keys and of
  // array indexes in decimal.
  [[noreturn]] void fail(const std::vector<std::string>& path, std::string_view message) const;

 private:
  std::filesystem::path file_;
  std::string text_;
  Json value_;
};

// Formats a value. Objects and arrays in the first `depth` levels are written with one member per
// line. Deeper objects and arrays are written on the line of the member that contains them.
[[nodiscard]] std::string to_lines(const Json& value, int depth);

}  // namespace triptych::core
