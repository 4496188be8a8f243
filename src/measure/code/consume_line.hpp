#pragma once
#include <cstddef>
#include <string_view>

namespace triptych::measure {

// Removes the first line of the text, with its line break, and returns it without the line break.
inline std::string_view consume_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace triptych::measure
