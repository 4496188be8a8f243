#include "core/quoting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

namespace triptych::core {
namespace {

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7F;
}

bool means_nothing(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
}

std::string within_dollar_quotes(std::string_view word) {
  std::string text = "$'";
  for (std::string_view rest = word; !rest.empty();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(rest), 1);
    const std::string_view character = rest.substr(0, length);
    rest.remove_prefix(length);
    if (character == "'" || character == "\\") {
      text += '\\';
      text += character;
    } else if (is_line(character)) {
      text += character;
    } else {
      for (const char c : character) text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    }
  }
  return text + "'";
}

}  // namespace

std::string shell_quoted(std::string_view word) {
  if (!is_line(word)) return within_dollar_quotes(word);
  if (!word.empty() && std::ranges::all_of(word, means_nothing)) return std::string(word);
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text += "'\\''";
    } else {
      text += c;
    }
  }
  return text + "'";
}

std::string shell_command(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    text += shell_quoted(word);
  }
  return text;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  std::size_t before_last = 0;  // where the text is cut if it is too long
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count + 1 == limit) before_last = result.size();
    if (count == limit) {
      result.resize(before_last);
      result += "…";
      return result;
    }
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    text.remove_prefix(character.size());
    if (length == 0) {
      result += replacement_character;
    } else if (is_line(character)) {
      result += character;
    } else if (character == "\n") {
      result += "\\n";
    } else if (length == 1 && is_control(character.front())) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(character.front()));
    } else {
      result += replacement_character;
    }
  }
  return result;
}

}  // namespace triptych::core
