#pragma once
// Text of unknown origin, such as names in files and messages of drivers and users.

#include <cstddef>
#include <string>
#include <string_view>

namespace triptych::core {

// Replaces bytes that are not a character.
inline constexpr std::string_view replacement_character = "\uFFFD";

// The number of bytes of the valid UTF-8 character (Unicode 15, table 3-7) at the beginning of a
// text; 0 if there is none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

[[nodiscard]] char32_t code_point(std::string_view character);

// Whether a well-formed UTF-8 character changes how the text around it is displayed instead of
// displaying something itself: C0 and C1 control characters, DEL, line and paragraph separators,
// characters that change the direction of text (such as U+202E), invisible characters, and
// noncharacters. In a name, such a character can make a reader see a different name or send a
// control sequence to the terminal, so every output shows it as an escape. The joiners U+200C and
// U+200D are part of words in some scripts and are not hidden.
[[nodiscard]] bool is_hidden(std::string_view character);

// Whether the text is UTF-8 without hidden characters. Such a text can be written in a line, in JSON
// and in XML, and is read back unchanged.
[[nodiscard]] bool is_line(std::string_view text);

// The text with every word that contains a digit replaced by #, so that messages that differ only
// in their numbers become equal.
[[nodiscard]] std::string without_numbers(std::string_view text);

}  // namespace triptych::core
