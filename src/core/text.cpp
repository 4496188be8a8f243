#include "core/text.hpp"

#include <algorithm>
#include <cctype>

namespace triptych::core {
namespace {

unsigned char byte_at(std::string_view text, std::size_t index) {
  return index < text.size() ? static_cast<unsigned char>(text[index]) : 0;
}

bool is_continuation(unsigned char byte) {
  return byte >= 0x80 && byte <= 0xBF;
}

// Whether the second byte is valid after the first one: not an overlong encoding, not a surrogate,
// and not beyond U+10FFFF.
bool may_follow(unsigned char first, unsigned char second) {
  if (!is_continuation(second)) return false;
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second <= 0x9F;
  if (first == 0xF0) return second >= 0x90;
  if (first == 0xF4) return second <= 0x8F;
  return true;
}

// C0, DEL and C1, line and paragraph separators, and code points that are not characters in XML.
bool is_control(std::string_view character) {
  if (character.size() == 1) return character.front() < 0x20 || character.front() == 0x7F;
  if (character.size() == 2) return character >= "\u0080" && character <= "\u009F";
  return character == "\u2028" || character == "\u2029" || character == "\uFFFE" ||
         character == "\uFFFF";
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned char first = byte_at(text, 0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (!may_follow(first, byte_at(text, 1))) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (!is_continuation(byte_at(text, i))) return 0;
  }
  return length;
}

bool is_line(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || is_control(text.substr(0, length))) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string without_numbers(std::string_view text) {
  constexpr std::string_view between = " ,;:()[]";
  std::string shape;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find_first_of(between), text.size());
    const std::string_view word = text.substr(0, length);
    const bool number = std::ranges::any_of(
        word, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    shape += number ? std::string_view("#") : word;
    const std::size_t after = std::min(length + 1, text.size());
    shape += text.substr(length, after - length);
    text.remove_prefix(after);
  }
  return shape;
}

}  // namespace triptych::core
