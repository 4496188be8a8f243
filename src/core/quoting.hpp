#pragma once
// Makes text of unknown origin safe in commands that users paste, and on terminals.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// One word of a shell command, spelled so that every POSIX shell (dash, bash, zsh, BusyBox, ksh)
// reads the same word, in a script and at a prompt. It is unchanged if no character in it is special
// to a shell, otherwise it is in single quotes. A word with hidden characters (core/text.hpp) or
// bytes that are not UTF-8 becomes "$(printf 'FORMAT')" with octal escapes, so that the command has
// one line and shows them. Line ends at the end of such a word follow it in single quotes, because
// $(…) drops them.
[[nodiscard]] std::string shell_quoted(std::string_view word);
// Whether a shell accepts NAME=VALUE with this name. Other variables can only be set by `env`.
[[nodiscard]] bool is_shell_name(std::string_view name);
// The text before a command that sets these variables for it, with a space at its end:
// "A=1 B='x y' ", or "env 'A.B=1' " if a shell does not accept one of the names. Empty for no
// variables.
[[nodiscard]] std::string shell_environment(const std::map<std::string, std::string>& variables);
// Words, each quoted, separated by spaces.
[[nodiscard]] std::string shell_command(std::span<const std::string> words);

// Text for a line on a terminal: control characters become "\x1b", line ends "\n", other hidden
// characters (core/text.hpp) "\u{202e}", and bytes that are not UTF-8 become U+FFFD. It is cut to
// `limit` characters, the last of which is then "…".
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 2000);
// The same for a text of several lines: line ends stay, and nothing is cut.
[[nodiscard]] std::string printable_lines(std::string_view text);
// The escape of one hidden character in such a text.
[[nodiscard]] std::string visible(std::string_view character);

}  // namespace triptych::core
