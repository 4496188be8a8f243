#include "core/json_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/foreign_error.hpp"
#include "core/json_text.hpp"

namespace triptych::core {
namespace {

FilePlace place_at(const std::filesystem::path& file, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line_start = before.find_last_of('\n');
  const std::size_t column =
      line_start == std::string_view::npos ? before.size() : before.size() - line_start - 1;
  return {file.string(), static_cast<int>(1 + std::ranges::count(before, '\n')),
          static_cast<int>(column + 1)};
}

// Returns the message of the JSON library without its prefix, which states the error id and the
// position.
std::string bare_message(std::string_view what) {
  const auto start = what.find("syntax error");
  return std::string(start == std::string_view::npos ? what : what.substr(start));
}

// Returns the offset of the value at `path`. The function searches for the keys of the path one
// after the other, starting each search at the previous match. The result is exact for files that
// `triptych accept` writes. In a file that was written by hand, the result may be an earlier place
// with the same keys. Therefore the error message also states the path.
std::size_t offset_of(std::string_view text, const std::vector<std::string>& path) {
  std::size_t offset = 0;
  for (const std::string& step : path) {
    const std::size_t found = text.find(Json(step).dump() + ":", offset);
    if (found != std::string_view::npos) offset = found;
  }
  return offset;
}

// Returns the offset of the n-th (1-based) occurrence of `key` as an object key.
std::size_t offset_of_key(std::string_view text, const std::string& key, std::size_t n) {
  const std::string quoted = Json(key).dump() + ":";
  std::size_t offset = text.find(quoted);
  while (--n > 0 && offset != std::string_view::npos) offset = text.find(quoted, offset + 1);
  return std::min(offset, text.size());
}

// Returns the quoted part of a message such as "… number overflow parsing '1e999'". The caller
// searches the file for this number, because the library does not report the position of this kind
// of error.
std::string quoted_in(std::string_view what) {
  const auto begin = std::min(what.find('\''), what.size());
  const auto end = std::min(what.rfind('\''), what.size());
  return std::string(end > begin ? what.substr(begin + 1, end - begin - 1) : what);
}

Json parse(const std::filesystem::path& file, const std::string& text) {
  std::vector<std::set<std::string>> open_objects;
  std::map<std::string, std::size_t> seen;
  const auto on_event = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto key = value.get<std::string>();
    const std::size_t occurrence = ++seen[key];
    if (!open_objects.back().insert(key).second) {
      throw InputError(place_at(file, text, offset_of_key(text, key, occurrence)),
                       fmt::format("the key '{}' appears twice in one object", key));
    }
    return true;
  };
  try {
    return Json::parse(text, on_event);
  } catch (const Json::parse_error& error) {
    const std::size_t offset = error.byte == 0 ? 0 : error.byte - 1;
    throw InputError(place_at(file, text, std::min(offset, text.size())),
                     bare_message(error.what()));
  } catch (const Json::out_of_range& error) {
    const std::string number = quoted_in(error.what());
    throw InputError(place_at(file, text, std::min(text.find(number), text.size())),
                     fmt::format("the number {} is too large", number));
  }
}

bool is_container(const Json& value) {
  return value.is_structured() && !value.empty();
}

void append_lines(std::string& out, const Json& value, int depth, int indent) {
  if (depth == 0 || !is_container(value)) {
    out += json_text(value);
    return;
  }
  const bool object = value.is_object();
  out += object ? "{\n" : "[\n";
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) out += ",\n";
    first = false;
    out.append(static_cast<std::size_t>(indent) + 1, ' ');
    if (object) out += json_text(Json(item.key())) + ": ";
    append_lines(out, item.value(), depth - 1, indent + 1);
  }
  out += '\n';
  out.append(static_cast<std::size_t>(indent), ' ');
  out += object ? '}' : ']';
}

}  // namespace

std::string to_lines(const Json& value, int depth) {
  std::string out;
  append_lines(out, value, depth, 0);
  return out + "\n";
}

JsonFile::JsonFile(std::filesystem::path file, std::string text)
    : file_(std::move(file)), text_(std::move(text)), value_(parse(file_, text_)) {}

std::optional<JsonFile> JsonFile::read(const std::filesystem::path& file) {
  const bool exists =
      with_error_context(file.string(), [&] { return std::filesystem::exists(file); });
  if (!exists) return std::nullopt;
  return JsonFile(file, read_text(file, core::most_json_bytes));
}

void JsonFile::fail(const std::vector<std::string>& path, std::string_view message) const {
  throw InputError(place_at(file_, text_, offset_of(text_, path)),
                   fmt::format("at /{}: {}", fmt::join(path, "/"), message));
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) fail("expected an object");
  std::vector<std::pair<std::string, JsonNode>> result;
  for (const auto& item : value_->items()) {
    result.emplace_back(item.key(), child(item.key(), item.value()));
  }
  return result;
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array()) fail("expected an array");
  std::vector<JsonNode> result;
  for (const auto& item : value_->items()) result.push_back(child(item.key(), item.value()));
  return result;
}

JsonNode JsonNode::at(const std::string& key) const {
  if (!value_->is_object()) fail("expected an object");
  const auto found = value_->find(key);
  if (found == value_->end()) file_->fail(path_, fmt::format("'{}' is missing", key));
  return child(key, *found);
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("expected a string");
  return value_->get<std::string>();
}

double JsonNode::positive_number() const {
  const double number = value_->is_number() ? value_->get<double>() : 0;
  if (!std::isfinite(number) || number <= 0) fail("expected a positive number");
  return number;
}

double JsonNode::number_from_zero() const {
  const double number = value_->is_number() ? value_->get<double>() : -1;
  if (!std::isfinite(number) || number < 0) fail("expected a number, 0 or more");
  return number;
}

std::uint64_t JsonNode::whole_number() const {
  if (!value_->is_number_unsigned()) fail("expected a whole number, 0 or more");
  return value_->get<std::uint64_t>();
}

void JsonNode::fail(std::string_view message) const {
  file_->fail(path_,
              fmt::format("{}, found {}", message,
                          value_->is_structured() ? value_->type_name() : json_text(*value_)));
}

JsonNode JsonNode::child(std::string name, const Json& value) const {
  std::vector<std::string> path = path_;
  path.push_back(std::move(name));
  return {*file_, value, std::move(path)};
}

}  // namespace triptych::core
