#include "core/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "core/text.hpp"

namespace triptych::core {
namespace {

// Returns the JSON escape of a character, such as "\u202e". A character outside the Basic
// Multilingual Plane is written as two escapes, a surrogate pair (RFC 8259, section 7).
std::string escaped(std::string_view character) {
  const auto code = static_cast<std::uint32_t>(code_point(character));
  if (code < 0x10000) return fmt::format("\\u{:04x}", code);
  const std::uint32_t rest = code - 0x10000;
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + (rest >> 10U), 0xDC00 + (rest & 0x3FFU));
}

}  // namespace

std::string json_text(const Json& json, int indent) {
  const std::string text = json.dump(indent, ' ', false, Json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view character = rest.substr(0, std::max<std::size_t>(utf8_length(rest), 1));
    rest.remove_prefix(character.size());
    // Line breaks are not escaped. They occur only between values, because dump() has already
    // escaped those within strings.
    const char first = character.front();
    if (first >= 0x20 && first < 0x7F) {
      result += first;
      continue;
    }
    result +=
        character != "\n" && is_hidden(character) ? escaped(character) : std::string(character);
  }
  return result;
}

}  // namespace triptych::core
