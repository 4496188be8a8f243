#pragma once
#include <string>

namespace triptych::report::words {

// `text`, followed by `detail` if there is any.
[[nodiscard]] inline std::string with_detail(std::string text, const std::string& detail) {
  if (!detail.empty()) text += (text.empty() ? "" : ": ") + detail;
  return text;
}

}  // namespace triptych::report::words
