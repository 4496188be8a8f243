#pragma once
// Functions for text from unknown sources, such as names in files and messages from drivers and
// users.

#include <cstddef>
#include <string>
#include <string_view>

namespace triptych::core {

// U+FFFD, which replaces bytes that are not valid UTF-8.
inline constexpr std::string_view replacement_character = "\uFFFD";

// Returns the length in bytes of the UTF-8 character at the beginning of `text`, or 0 if `text`
// does not begin with a valid character (Unicode 15, table 3-7).
[[nodiscard]] std::size_t utf8_length(std::string_view text);

// Returns the number of characters of well-formed UTF-8 text.
[[nodiscard]] std::size_t character_count(std::string_view text);

[[nodiscard]] char32_t code_point(std::string_view character);

// Returns whether a well-formed UTF-8 character has no glyph of its own, but may change how the
// text around it is displayed: C0 and C1 control characters, DEL, line and paragraph separators,
// characters that change the direction of text (such as U+202E), invisible characters, and
// noncharacters. In a name, such a character can make a reader see a different name or send a
// control sequence to the terminal, so every output shows it as an escape. The joiners U+200C and
// U+200D do not count as hidden, because they are part of words in some scripts.
[[nodiscard]] bool is_hidden(std::string_view character);

// Returns whether the text is valid UTF-8 without hidden characters. Such text fits on one line,
// and is read back unchanged from JSON and XML.
[[nodiscard]] bool is_line(std::string_view text);

}  // namespace triptych::core
