#pragma once
// Makes text from unknown sources safe to use in shell commands that users paste, and safe to print
// on terminals.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace triptych::core {

// Quotes one word of a shell command, so that every POSIX shell (dash, bash, zsh, BusyBox, ksh)
// reads the original word, both in a script and at an interactive prompt. A word without special
// characters is unchanged. A word with special characters is put in single quotes. A word with
// hidden characters (core/text.hpp) or invalid UTF-8 becomes "$(printf 'FORMAT')" with octal
// escapes, so that the command stays on one line and the hidden characters are visible. Line ends
// at the end of such a word are appended in single quotes, because $(…) would drop them.
[[nodiscard]] std::string shell_quoted(std::string_view word);
// Returns whether a shell accepts the assignment NAME=VALUE for this name. A variable with any
// other name can be set only by `env`.
[[nodiscard]] bool is_shell_name(std::string_view name);
// Returns the prefix that sets these variables for a command, such as "A=1 B='x y'", or "env
// 'A.B=1'" if a shell does not accept one of the names. The prefix ends with a space. It is empty
// if there are no variables.
[[nodiscard]] std::string shell_environment(const std::map<std::string, std::string>& variables);
// Quotes each word and joins the words with spaces.
[[nodiscard]] std::string shell_command(std::span<const std::string> words);

// Makes text safe to print on one line of a terminal. Control characters become escapes such as
// "\x1b", line ends become "\n", other hidden characters (core/text.hpp) become escapes such as
// "\u{202e}", and invalid UTF-8 becomes U+FFFD. Text that is longer than `limit` characters is cut,
// so that it has `limit` characters and ends with "…".
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 2000);
// Makes text safe to print on several lines of a terminal. Like printable(), but keeps line ends
// and tabs, and does not cut the text.
[[nodiscard]] std::string printable_lines(std::string_view text);
// Returns the escape that printable() writes instead of a hidden character.
[[nodiscard]] std::string visible(std::string_view character);

}  // namespace triptych::core
