#include "core/quoting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/text.hpp"

namespace triptych::core {
namespace {

bool is_safe_in_shell(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
}

// A word that begins with '=' needs quotes, because zsh replaces such a word with the path of a
// program.
bool needs_no_quotes(std::string_view word) {
  return !word.empty() && word.front() != '=' && std::ranges::all_of(word, is_safe_in_shell);
}

std::string within_quotes(std::string_view word) {
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

// Returns the word as a call of printf(1) inside double quotes. The format contains no '!', because
// an interactive bash would replace the '!' with an entry of its history.
std::string within_printf(std::string_view word) {
  std::string text = "\"$(printf '";
  for (std::string_view rest = word; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    const std::string_view character = rest.substr(0, std::max<std::size_t>(length, 1));
    rest.remove_prefix(character.size());
    const bool plain = length > 1 || is_safe_in_shell(character.front()) || character == " ";
    if (length > 0 && plain && character != "%" && !is_hidden(character)) {
      text += character;
    } else {
      for (const char c : character) text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    }
  }
  return text + "')\"";
}

}  // namespace

std::string shell_quoted(std::string_view word) {
  if (is_line(word)) return needs_no_quotes(word) ? std::string(word) : within_quotes(word);
  const std::size_t length_without_breaks = word.find_last_not_of('\n') + 1;
  const std::string_view line_breaks = word.substr(length_without_breaks);
  return (length_without_breaks > 0 ? within_printf(word.substr(0, length_without_breaks))
                                    : std::string()) +
         (line_breaks.empty() ? std::string() : within_quotes(line_breaks));
}

bool is_shell_name(std::string_view name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

std::string shell_environment(const std::map<std::string, std::string>& variables) {
  const bool all = std::ranges::all_of(
      variables, [](const auto& variable) { return is_shell_name(variable.first); });
  std::string text = all ? "" : "env ";
  for (const auto& [name, value] : variables) {
    text += all ? name + "=" + shell_quoted(value) : shell_quoted(name + "=" + value);
    text += ' ';
  }
  return text;
}

std::string shell_command(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    text += shell_quoted(word);
  }
  return text;
}

std::string visible(std::string_view character) {
  if (character == "\n") return "\\n";
  const auto code = static_cast<std::uint32_t>(code_point(character));
  return code < 0x80 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:04x}}}", code);
}

namespace {

// Removes the first character from the text and returns its printable form.
std::string take_printable(std::string_view& text) {
  const std::size_t length = utf8_length(text);
  const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
  text.remove_prefix(character.size());
  if (length == 0) return std::string(replacement_character);
  return is_hidden(character) ? visible(character) : std::string(character);
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  std::size_t before_last = 0;  // position at which text that is too long is cut
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count + 1 == limit) before_last = result.size();
    if (count == limit) {
      result.resize(before_last);
      result += "…";
      return result;
    }
    result += take_printable(text);
  }
  return result;
}

std::string printable_lines(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    if (text.front() == '\n' || text.front() == '\t') {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += take_printable(text);
    }
  }
  return result;
}

}  // namespace triptych::core
