#pragma once
// Rows that are copied from one store to another.

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "record/merge/query.hpp"

namespace triptych::record {

// Holds rows of one table as a sequence of values.
class RowBatch {
 public:
  void add(std::int64_t number) { cells_.emplace_back(number); }
  void add(std::string_view text) { cells_.push_back(append_text(text)); }
  void add(const Query& row, int first_column, int columns);
  void clear();

  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  [[nodiscard]] std::size_t bytes() const { return texts_.size(); }
  // Binds a value to a parameter of a statement. The statement must be executed before the batch
  // changes.
  void bind(Query& statement, int index, std::size_t cell) const;

 private:
  struct Text {
    std::size_t begin;
    std::size_t length;
  };
  using Cell = std::variant<std::nullptr_t, std::int64_t, double, Text>;

  [[nodiscard]] Cell cell_of(const Query& row, int column);
  [[nodiscard]] Text append_text(std::string_view text);

  std::vector<Cell> cells_;
  std::string texts_;
};

// Inserts the rows of batches into a table.
class RowWriter {
 public:
  RowWriter(const SQLite::Database& database, std::string_view table,
            const std::vector<std::string>& columns);

  // The batch must consist of complete rows, with one value for each of the columns.
  void write(const RowBatch& rows);

 private:
  std::size_t columns_;
  Query insert_several_;  // inserts several rows per execution, which is faster
  Query insert_one_;
};

}  // namespace triptych::record
