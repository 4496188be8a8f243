#pragma once
#include <string>

namespace triptych::report::words {

// Returns `text`, followed by a colon and `detail` unless `detail` is empty.
[[nodiscard]] inline std::string with_detail(std::string text, const std::string& detail) {
  if (!detail.empty()) text += (text.empty() ? "" : ": ") + detail;
  return text;
}

}  // namespace triptych::report::words
