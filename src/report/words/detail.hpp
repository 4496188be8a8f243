#pragma once
#include <string>

namespace triptych::report::words {

// `text`, then `detail` where there is one.
[[nodiscard]] inline std::string with_detail(std::string text, const std::string& detail) {
  if (!detail.empty()) text += (text.empty() ? "" : ": ") + detail;
  return text;
}

}  // namespace triptych::report::words
