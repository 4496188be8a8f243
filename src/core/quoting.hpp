#pragma once
// Text of unknown origin in commands that people paste, and on their terminals.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// One word of a shell's command line: as it is where nothing in it means anything to a shell, else
// in single quotes. Control characters become $'\x1b', which bash, zsh and ksh read back.
[[nodiscard]] std::string shell_quoted(std::string_view word);
// Words, each quoted, with spaces between.
[[nodiscard]] std::string shell_command(std::span<const std::string> words);

// For a line on a terminal: control characters as "\x1b", line ends as "\n", what is no UTF-8 as
// U+FFFD; cut to so many characters, the last of them "…".
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 2000);

}  // namespace triptych::core
