#pragma once
#include <string>
#include <vector>

namespace triptych::report {

// Formats a table with left-aligned columns, two spaces apart. All rows must have the same number
// of cells, and there must be at least one row.
[[nodiscard]] std::string aligned_columns(const std::vector<std::vector<std::string>>& rows);

}  // namespace triptych::report
