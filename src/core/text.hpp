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

// Whether the text is UTF-8 without control characters or line breaks. Such a text can be written
// in a line, in JSON and in XML, and is read back unchanged.
[[nodiscard]] bool is_line(std::string_view text);

// The text with every word that contains a digit replaced by #. The result is the same for messages
// of one kind.
[[nodiscard]] std::string without_numbers(std::string_view text);

}  // namespace triptych::core
