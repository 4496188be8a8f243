#include "report/screen/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

namespace triptych::report {

std::string aligned_columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      widths[i] = std::max(widths[i], core::character_count(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
      text += fmt::format("{:<{}}", row[i], widths[i] + 2);
    }
    text += row.back() + "\n";
  }
  return text;
}

}  // namespace triptych::report
