#pragma once
// Parsing of small text formats, independent of the locale.

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace triptych::scene {

// Lines without their ends, which may be LF or CR LF; the end of the last one may be missing.
[[nodiscard]] std::vector<std::string_view> split_lines(std::string_view text);

// The parts that are separated by blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view text);

// The text without the byte order mark of UTF-8, which some editors put before it.
[[nodiscard]] std::string_view without_mark(std::string_view text);

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);

// A word of a file in the form in which messages quote it: on one line, with at most 40 characters,
// and without characters that control a terminal.
[[nodiscard]] std::string quotable(std::string_view word);

// The number that the whole word represents; nullopt if it is not a number or the type cannot hold
// it.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view word) {
  Number value{};
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace triptych::scene
