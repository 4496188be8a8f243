#pragma once
// JSON files that people review and merge by hand: read with the place of every mistake, written
// with one value per line.

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

// A value within a JsonFile, which must outlive it. Every accessor throws InputError with file,
// line and the path within the file when the value is not what is asked for.
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
  [[nodiscard]] double number_from_zero() const;  // 0 or more
  [[nodiscard]] std::uint64_t whole_number() const;
  [[noreturn]] void fail(std::string_view message) const;

 private:
  [[nodiscard]] JsonNode child(std::string name, const Json& value) const;
  const JsonFile* file_;
  const Json* value_;
  std::vector<std::string> path_;
};

class JsonFile {
 public:
  // nullopt when there is no such file; InputError with line and column when it is not JSON or has
  // one key twice in an object (what a careless merge leaves).
  [[nodiscard]] static std::optional<JsonFile> read(const std::filesystem::path& file);
  // A file's text, which may not have been written yet.
  JsonFile(std::filesystem::path file, std::string text);

  [[nodiscard]] JsonNode root() const { return {*this, value_, {}}; }
  [[nodiscard]] const Json& value() const noexcept { return value_; }
  // InputError with the line of the value at `path` (keys, or indexes in decimal).
  [[noreturn]] void fail(const std::vector<std::string>& path, std::string_view message) const;

 private:
  std::filesystem::path file_;
  std::string text_;
  Json value_;
};

// Objects and arrays down to `depth` levels with one member per line, deeper ones on their member's
// line.
[[nodiscard]] std::string to_lines(const Json& value, int depth);

}  // namespace triptych::core
