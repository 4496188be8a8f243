#include "report/exports/csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/error.hpp"

namespace triptych::report {
namespace {

struct Field {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double number) const {
    return std::isnan(number) ? std::string() : fmt::format("{}", number);
  }
  std::string operator()(std::uint64_t number) const { return fmt::format("{}", number); }
  std::string operator()(const std::string& text) const {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
      if (c == '"') quoted += c;
      quoted += c;
    }
    return quoted + '"';
  }
};

}  // namespace

std::string csv_field(const Cell& cell) {
  return std::visit(Field{}, cell);
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
