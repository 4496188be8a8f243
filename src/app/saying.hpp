#pragma once
// What commands write on a terminal: answers on stdout; progress, notes and errors on stderr, where
// nobody's refusal to take them ends a run.

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

// Names and messages may come from anywhere: as a terminal can show them, and cut where they are
// endless. What moves the cursor or ends a line stands in the format.
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

// A text that is laid out already, in lines: what a terminal would obey in it becomes escapes.
inline void put_lines(std::string_view text, std::FILE* to = stdout) {
  const std::string lines = core::printable_lines(text);
  static_cast<void>(std::fwrite(lines.data(), 1, lines.size(), to));
}

// Whether a terminal shows it.
[[nodiscard]] bool watched();
// Of a terminal, what show() left there.
void clear_line();

// Progress: a line that rewrites itself on a terminal, a line per step elsewhere.
template <typename... Args>
void show(fmt::format_string<Args...> format, Args&&... args) {
  clear_line();
  say(format, std::forward<Args>(args)...);
  if (!watched()) say("\n");
}
// Gone at the end.
void show_loading(const measure::Loading& loading);

}  // namespace triptych::app
