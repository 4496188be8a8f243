#pragma once
// Writes tables as CSV (RFC 4180, but with LF line endings) row by row.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::report {

// A missing value is an empty field, never zero.
using Cell = std::variant<std::monostate, std::string, double, std::uint64_t>;

// Formats one field. NaN becomes an empty field. Text that contains a separator, a quotation mark
// or a line break is quoted. Text that a spreadsheet would evaluate as a formula, or that begins
// with an apostrophe, gets a leading apostrophe. Numbers are written with the fewest digits from
// which exactly the same number can be parsed.
[[nodiscard]] std::string csv_field(const Cell& cell);

class CsvFile {
 public:
  // Replaces the file. All functions of this class throw core::IoError if writing fails.
  CsvFile(std::filesystem::path file, std::span<const std::string> columns);
  void add(std::span<const Cell> row);  // `row` has one cell for each column
  void close();                         // writes everything to the file
  [[nodiscard]] std::uint64_t rows() const { return rows_; }

 private:
  void require_written();

  std::filesystem::path file_;
  std::ofstream out_;
  std::string line_;
  std::uint64_t rows_ = 0;
};

}  // namespace triptych::report
