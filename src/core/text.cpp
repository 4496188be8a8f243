#include "core/text.hpp"

#include <algorithm>
#include <array>

namespace triptych::core {
namespace {

unsigned char byte_at(std::string_view text, std::size_t index) {
  return index < text.size() ? static_cast<unsigned char>(text[index]) : 0;
}

bool is_continuation(unsigned char byte) {
  return byte >= 0x80 && byte <= 0xBF;
}

// Returns whether the second byte may follow the first byte. Excludes overlong encodings,
// surrogates, and code points beyond U+10FFFF.
bool may_follow(unsigned char first, unsigned char second) {
  if (!is_continuation(second)) return false;
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second <= 0x9F;
  if (first == 0xF0) return second >= 0x90;
  if (first == 0xF4) return second <= 0x8F;
  return true;
}

struct Range {
  char32_t first;
  char32_t last;
};
// Sorted ranges of hidden characters in Unicode 15: all characters of the general categories Cc, Zl
// and Zp; the format characters (category Cf), except the joiners, the Egyptian hieroglyph controls
// and the characters with a glyph, such as U+0600; the supplementary variation selectors, which are
// invisible; and the noncharacters U+FFFE and U+FFFF, which XML forbids.
constexpr std::array<Range, 15> hidden{{
    {0x00, 0x1F},        // C0
    {0x7F, 0x9F},        // DEL, C1
    {0xAD, 0xAD},        // soft hyphen
    {0x061C, 0x061C},    // Arabic letter mark
    {0x180E, 0x180E},    // Mongolian vowel separator
    {0x200B, 0x200B},    // zero width space
    {0x200E, 0x200F},    // left-to-right and right-to-left marks
    {0x2028, 0x202E},    // line and paragraph separators; bidirectional embeddings and overrides
    {0x2060, 0x206F},    // word joiner, bidirectional isolates, deprecated characters
    {0xFEFF, 0xFEFF},    // zero width no-break space
    {0xFFF9, 0xFFFB},    // interlinear annotation
    {0xFFFE, 0xFFFF},    // noncharacters
    {0x1BCA0, 0x1BCA3},  // shorthand format controls
    {0x1D173, 0x1D17A},  // musical symbol format controls
    {0xE0000, 0xE0FFF},  // tags and the supplementary variation selectors
}};

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

std::size_t character_count(std::string_view text) {
  // Counts the bytes that begin a character.
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

char32_t code_point(std::string_view character) {
  const unsigned char first = byte_at(character, 0);
  if (character.size() == 1) return first;
  constexpr std::array<unsigned char, 5> payload{0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t code = first & payload.at(character.size());
  for (std::size_t i = 1; i < character.size(); ++i) {
    code = code << 6U | (byte_at(character, i) & 0x3FU);
  }
  return code;
}

bool is_hidden(std::string_view character) {
  const char32_t code = code_point(character);
  const auto* range = std::ranges::lower_bound(hidden, code, {}, &Range::last);
  return range != hidden.end() && code >= range->first;
}

bool is_line(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || is_hidden(text.substr(0, length))) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace triptych::core
