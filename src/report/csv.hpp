#pragma once
// Tables as CSV (RFC 4180, with lines that end in LF), written row by row.

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

// NaN is written as missing. A text that contains a separator, a quotation mark or the end of a
// line is quoted. A text that a spreadsheet would run as a formula, or that begins with an
// apostrophe, gets an apostrophe before it. Numbers have as few digits as are needed to read the
// same number again.
[[nodiscard]] std::string csv_field(const Cell& cell);

class CsvFile {
 public:
  // Replaces the file. Throws core::IoError, as do all functions of this class.
  CsvFile(std::filesystem::path file, std::span<const std::string> columns);
  void add(std::span<const Cell> row);  // `row` has one cell for each column
  void close();                         // after this, the file contains everything that was added
  [[nodiscard]] std::uint64_t rows() const { return rows_; }

 private:
  void require_written();

  std::filesystem::path file_;
  std::ofstream out_;
  std::string line_;
  std::uint64_t rows_ = 0;
};

}  // namespace triptych::report
