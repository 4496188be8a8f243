#pragma once
// Parsing of small text formats, independent of the locale.

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace triptych::scene {

// Returns the lines without their line ends, which may be LF or CR LF. The last line may lack a
// line end.
[[nodiscard]] std::vector<std::string_view> split_lines(std::string_view text);

// Returns the parts of the text that are separated by blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view text);

// Returns the text without the UTF-8 byte order mark that some editors put at the beginning.
[[nodiscard]] std::string_view without_mark(std::string_view text);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);

// Returns a word from a file in a form that is suitable for messages: on one line, with at most 40
// characters, and without characters that control a terminal.
[[nodiscard]] std::string quotable(std::string_view word);

// Returns the number that the whole word represents, or nullopt if the word is not a number or the
// number does not fit into the type.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view word) {
  Number value{};
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace triptych::scene
