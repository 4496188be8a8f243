#pragma once
// Tables as CSV (RFC 4180, lines ended by LF), written a row at a time.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace triptych::report {

// Missing is an empty field, never zero.
using Cell = std::variant<std::monostate, std::string, double, std::uint64_t>;

// A number that is none is missing; a text that holds a comma, a quote or a line end is quoted.
// Numbers have the fewest digits that give the same number back.
[[nodiscard]] std::string csv_field(const Cell& cell);

class CsvFile {
 public:
  // Replaces the file. Throws core::IoError, as do all of its functions.
  CsvFile(std::filesystem::path file, std::span<const std::string> columns);
  void add(std::span<const Cell> row);  // as many cells as columns
  void close();                         // what was added is in the file
  [[nodiscard]] std::uint64_t rows() const { return rows_; }

 private:
  void require_written();

  std::filesystem::path file_;
  std::ofstream out_;
  std::string line_;
  std::uint64_t rows_ = 0;
};

}  // namespace triptych::report
