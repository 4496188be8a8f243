#pragma once
// Makes text of unknown origin safe in commands that users paste, and on terminals.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// One word of a shell command. It is unchanged if no character in it is special to a shell,
// otherwise it is in single quotes. Control characters become $'\x1b', which bash, zsh and ksh can
// read back.
[[nodiscard]] std::string shell_quoted(std::string_view word);
// Words, each quoted, separated by spaces.
[[nodiscard]] std::string shell_command(std::span<const std::string> words);

// Text for a line on a terminal: control characters become "\x1b", line ends "\n", and bytes that
// are not UTF-8 become U+FFFD. It is cut to `limit` characters, the last of which is then "…".
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 2000);

}  // namespace triptych::core
