#include "record/merge/row_batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace triptych::record {
namespace {

constexpr std::size_t rows_per_insert = 32;

std::string insert_of(std::string_view table, const std::vector<std::string>& columns,
                      std::size_t rows) {
  const std::string row =
      fmt::format("({})", fmt::join(std::vector<std::string>(columns.size(), "?"), ", "));
  return fmt::format("INSERT INTO {} ({}) VALUES {}", table, fmt::join(columns, ", "),
                     fmt::join(std::vector<std::string>(rows, row), ", "));
}

}  // namespace

void RowBatch::add(const Query& row, int first_column, int columns) {
  for (int i = 0; i < columns; ++i) cells_.push_back(cell_of(row, first_column + i));
}

void RowBatch::clear() {
  cells_.clear();
  texts_.clear();
}

RowBatch::Cell RowBatch::cell_of(const Query& row, int column) {
  sqlite3_value* value = sqlite3_column_value(row.get(), column);
  switch (sqlite3_value_type(value)) {
    case SQLITE_NULL:
      return nullptr;
    case SQLITE_INTEGER:
      return std::int64_t{sqlite3_value_int64(value)};
    case SQLITE_FLOAT:
      return sqlite3_value_double(value);
    default: {  // no column of a record is a blob
      const auto* text = reinterpret_cast<const char*>(sqlite3_value_text(value));
      return append_text({text, static_cast<std::size_t>(sqlite3_value_bytes(value))});
    }
  }
}

RowBatch::Text RowBatch::append_text(std::string_view text) {
  const std::size_t begin = texts_.size();
  texts_ += text;
  return {begin, text.size()};
}

void RowBatch::bind(Query& statement, int index, std::size_t cell) const {
  if (const auto* text = std::get_if<Text>(&cells_[cell])) {
    statement.bind(index, std::string_view(texts_).substr(text->begin, text->length));
  } else if (const auto* number = std::get_if<std::int64_t>(&cells_[cell])) {
    statement.bind(index, *number);
  } else if (const auto* real = std::get_if<double>(&cells_[cell])) {
    statement.bind(index, *real);
  } else {
    statement.bind(index, nullptr);
  }
}

RowWriter::RowWriter(const SQLite::Database& database, std::string_view table,
                     const std::vector<std::string>& columns)
    : columns_(columns.size()),
      insert_several_(database, insert_of(table, columns, rows_per_insert)),
      insert_one_(database, insert_of(table, columns, 1)) {}

void RowWriter::write(const RowBatch& rows) {
  for (std::size_t cell = 0; cell < rows.cells();) {
    const bool is_full = rows.cells() - cell >= rows_per_insert * columns_;
    const std::size_t end = cell + (is_full ? rows_per_insert : 1) * columns_;
    Query& insert = is_full ? insert_several_ : insert_one_;
    for (int index = 1; cell < end; ++index, ++cell) rows.bind(insert, index, cell);
    insert.execute();
  }
}

}  // namespace triptych::record
