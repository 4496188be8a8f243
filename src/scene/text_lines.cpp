#include "scene/text_lines.hpp"

#include <algorithm>

#include "core/text.hpp"

namespace triptych::scene {
namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<std::string_view> split_words(std::string_view text) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return words;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

// Converts only ASCII letters, regardless of the locale.
std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string quotable(std::string_view word) {
  constexpr int longest = 40;
  std::string text;
  for (int i = 0; i < longest && !word.empty(); ++i) {
    const std::size_t length = core::utf8_length(word);
    const std::string_view character = word.substr(0, length);
    text += length > 0 && core::is_line(character) ? character : core::replacement_character;
    word.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return word.empty() ? text : text + "…";
}

}  // namespace triptych::scene
