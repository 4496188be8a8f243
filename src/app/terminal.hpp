#pragma once
// Output of commands on a terminal: answers go to stdout; progress, notes and errors go to stderr.
// If stderr cannot be written, the run continues.

#include <fmt/format.h>

#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/quoting.hpp"
#include "measure/contract/loading.hpp"

namespace triptych::app {

// Names and messages may come from any source. They are printed so that a terminal shows them as
// text, and very long ones are cut. Only the format contains characters that move the cursor or end
// a line.
template <typename Arg>
auto shown(const Arg& arg) {
  if constexpr (std::convertible_to<const Arg&, std::string_view>) {
    return core::printable(arg);
  } else {
    return arg;
  }
}

template <typename... Args>
std::string shown_text(fmt::format_string<Args...> format, Args&&... args) {
  const auto all = std::make_tuple(shown(args)...);
  return std::apply(
      [&](const auto&... each) {
        return fmt::vformat(fmt::string_view(format), fmt::make_format_args(each...));
      },
      all);
}

template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = shown_text(format, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

// The same on stdout.
template <typename... Args>
void put(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = shown_text(format, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stdout));
}

// For a text that already consists of lines: everything in it that a terminal would obey is printed
// as an escape.
inline void put_lines(std::string_view text, std::FILE* to = stdout) {
  const std::string lines = core::printable_lines(text);
  static_cast<void>(std::fwrite(lines.data(), 1, lines.size(), to));
}

// Whether the output is shown by a terminal.
[[nodiscard]] bool watched();
// The columns of that terminal; 0 without a terminal.
[[nodiscard]] std::size_t columns();
// On a terminal, removes the progress line that show_line() has printed.
void clear_line();

// Shows progress: one line that is rewritten on a terminal and cut to its width, and a line for
// each step elsewhere.
void show_line(std::string_view text);
template <typename... Args>
void show(fmt::format_string<Args...> format, Args&&... args) {
  show_line(shown_text(format, std::forward<Args>(args)...));
}
// Reports something that had to be guessed about the data. A note is printed once, although each
// process that reads the data sends it.
void show_note(const measure::Loading& loading);
// The line disappears when loading has ended.
void show_loading(const measure::Loading& loading);

}  // namespace triptych::app
