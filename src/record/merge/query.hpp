#pragma once
// A prepared statement that binds and returns values without copying them, because a merge moves
// hundreds of millions of values.

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string_view>

namespace triptych::record {

// All functions throw SQLite::Exception.
class Query {
 public:
  Query(const SQLite::Database& database, std::string_view sql) : database_(database.getHandle()) {
    sqlite3_stmt* statement = nullptr;
    require(sqlite3_prepare_v3(database_, sql.data(), static_cast<int>(sql.size()),
                               SQLITE_PREPARE_PERSISTENT, &statement, nullptr));
    statement_.reset(statement);
  }

  [[nodiscard]] sqlite3_stmt* get() const { return statement_.get(); }

  // Advances to the next row; returns false if there is none.
  bool step() {
    const int answer = sqlite3_step(get());
    if (answer != SQLITE_ROW && answer != SQLITE_DONE) require(answer);
    return answer == SQLITE_ROW;
  }
  void reset() { require(sqlite3_reset(get())); }
  void execute() {
    while (step()) {
    }
    reset();
  }

  void bind(int index, std::int64_t number) { require(sqlite3_bind_int64(get(), index, number)); }
  void bind(int index, double number) { require(sqlite3_bind_double(get(), index, number)); }
  void bind(int index, std::nullptr_t /*null*/) { require(sqlite3_bind_null(get(), index)); }
  // Binds a string without copying it. The string must stay valid until the next step().
  void bind(int index, std::string_view text) {
    require(sqlite3_bind_text(get(), index, text.data(), static_cast<int>(text.size()), nullptr));
  }
  // Binds the value in a column of another statement's current row. That statement must stay on
  // this row until the next step() of this statement.
  void bind(int index, const Query& row, int column) {
    require(sqlite3_bind_value(get(), index, sqlite3_column_value(row.get(), column)));
  }

  // These functions return values of the current row. A string is valid until the next step().
  [[nodiscard]] std::string_view text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(get(), column));
    if (bytes == nullptr) return {};
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(get(), column))};
  }
  [[nodiscard]] std::int64_t integer(int column) const {
    return sqlite3_column_int64(get(), column);
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  void require(int answer) const {
    if (answer != SQLITE_OK) throw SQLite::Exception(database_, answer);
  }

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace triptych::record
