#pragma once
// What is said on stderr: progress, notes, errors. That nobody can take it ends no run.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace triptych::app {

template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace triptych::app
