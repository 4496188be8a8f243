#include "report/csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/error.hpp"

namespace triptych::report {
namespace {

bool is_number(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

// Returns whether the text must get a leading apostrophe. This is the case if a spreadsheet would
// evaluate the text as a formula, and if the text already begins with an apostrophe. Removing one
// leading apostrophe therefore always restores the original text.
bool needs_apostrophe(std::string_view text) {
  constexpr std::string_view starts = "=+-@\t\r\n'";
  if (text.empty()) return false;
  const bool wide = text.starts_with("＝") || text.starts_with("＋") || text.starts_with("－") ||
                    text.starts_with("＠");  // full-width forms, which some spreadsheets accept
  return wide || (starts.find(text.front()) != std::string_view::npos && !is_number(text));
}

struct FieldFormatter {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double number) const {
    return std::isnan(number) ? std::string() : fmt::format("{}", number);
  }
  std::string operator()(std::uint64_t number) const { return fmt::format("{}", number); }
  std::string operator()(const std::string& text) const {
    const std::string_view mark = needs_apostrophe(text) ? "'" : "";
    // Text with semicolons or tabs is quoted, because spreadsheets may use these as separators.
    if (text.find_first_of(",;\t\"\r\n") == std::string::npos) return std::string(mark) + text;
    std::string quoted = "\"";
    quoted += mark;
    for (const char c : text) {
      if (c == '"') quoted += c;
      quoted += c;
    }
    return quoted + '"';
  }
};

}  // namespace

std::string csv_field(const Cell& cell) {
  return std::visit(FieldFormatter{}, cell);
}

CsvFile::CsvFile(std::filesystem::path file, std::span<const std::string> columns)
    : file_(std::move(file)), out_(file_, std::ios::binary | std::ios::trunc) {
  require_written();
  const std::vector<Cell> names(columns.begin(), columns.end());
  add(names);
  rows_ = 0;
}

void CsvFile::add(std::span<const Cell> row) {
  line_.clear();
  for (const Cell& cell : row) {
    if (&cell != row.data()) line_ += ',';
    line_ += csv_field(cell);
  }
  line_ += '\n';
  out_ << line_;
  require_written();
  ++rows_;
}

void CsvFile::close() {
  out_.close();
  require_written();
}

void CsvFile::require_written() {
  if (out_) return;
  throw core::IoError(
      fmt::format("{} cannot be written: {}", file_.string(), std::strerror(errno)));
}

}  // namespace triptych::report
