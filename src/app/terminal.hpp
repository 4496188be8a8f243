#pragma once
// Terminal output of commands. Results go to stdout; progress, notes and errors go to stderr. If
// stderr cannot be written, the run continues.

#include <fmt/format.h>

#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/quoting.hpp"
#include "measure/contract/loading.hpp"
#include "measure/contract/suite.hpp"

namespace triptych::app {

// Names and messages may come from untrusted sources. Their control characters are escaped, and
// very long strings are truncated. Only the format string may contain characters that move the
// cursor or end a line.
template <typename Arg>
auto escaped_argument(const Arg& arg) {
  if constexpr (std::convertible_to<const Arg&, std::string_view>) {
    return core::printable(arg);
  } else {
    return arg;
  }
}

template <typename... Args>
std::string escaped_text(fmt::format_string<Args...> format, Args&&... args) {
  const auto all = std::make_tuple(escaped_argument(args)...);
  return std::apply(
      [&](const auto&... each) {
        return fmt::vformat(fmt::string_view(format), fmt::make_format_args(each...));
      },
      all);
}

template <typename... Args>
void print_err(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = escaped_text(format, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

// Like print_err(), but prints to stdout.
template <typename... Args>
void print_out(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = escaped_text(format, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
}

// Prints text that already consists of lines. Control characters other than line ends
// and tabs are escaped.
inline void print_lines(std::string_view text, std::FILE* to = stdout) {
  const std::string lines = core::printable_lines(text);
  static_cast<void>(std::fwrite(lines.data(), 1, lines.size(), to));
}

// Returns whether stderr is a terminal.
[[nodiscard]] bool stderr_is_terminal();
// Returns the width of the terminal in columns, or 0 if stderr is not a terminal.
[[nodiscard]] std::size_t terminal_width();
// On a terminal, erases the progress line that show_progress_line() has printed.
void clear_line();

// Shows progress. On a terminal, this is a single line, truncated to the terminal's width, which
// each call overwrites. If stderr is not a terminal, each call prints a new line.
void show_progress_line(std::string_view text);
template <typename... Args>
void show_progress(fmt::format_string<Args...> format, Args&&... args) {
  show_progress_line(escaped_text(format, std::forward<Args>(args)...));
}
// Prints a note about an assumption that was made about the data. Each note is printed only once,
// although every process that loads the data sends it.
void show_note(const measure::Loading& loading);
// Shows the progress of loading data. On a terminal, the line disappears when loading has ended.
void show_loading(const measure::Loading& loading);
// Shows the progress of rendering a reference image or a limit image, if this takes long.
void show_rendering(const measure::Rendering& rendering);

}  // namespace triptych::app
