#pragma once
// Text of unknown origin: names in files, what drivers and users say.

#include <cstddef>
#include <string>
#include <string_view>

namespace triptych::core {

// Stands for what is no character.
inline constexpr std::string_view replacement_character = "\uFFFD";

// The bytes of the well-formed UTF-8 character (Unicode 15, table 3-7) that a text begins with;
// 0 where it begins with none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

// Whether the text is UTF-8 without a control character or a line break: what may stand in a line,
// in JSON and in XML, and is read back as it was written.
[[nodiscard]] bool is_line(std::string_view text);

// With a # for every word that has a digit: what differs between messages of one kind.
[[nodiscard]] std::string without_numbers(std::string_view text);

}  // namespace triptych::core
