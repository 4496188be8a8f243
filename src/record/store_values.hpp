#pragma once
// Binds values to SQL statements and reads values from their result rows. Only store.cpp,
// store_records.cpp and store_runs.cpp use this file.

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace triptych::record {

// Binds the parameters of a statement in the order of the calls.
class Binder {
 public:
  explicit Binder(SQLite::Statement& statement) : statement_(statement) {}

  Binder& operator<<(std::string_view text) {
    statement_.bind(++index_, std::string(text));
    return *this;
  }
  Binder& operator<<(const std::optional<double>& number) {
    ++index_;
    if (number) {
      statement_.bind(index_, *number);  // NaN becomes NULL
    } else {
      statement_.bind(index_);
    }
    return *this;
  }
  // The bits of unsigned 64-bit numbers are stored unchanged, so SQL queries return numbers of 2⁶³
  // or more as negative numbers.
  template <typename T>
  requires std::integral<T> Binder& operator<<(T number) {
    statement_.bind(++index_, static_cast<std::int64_t>(number));
    return *this;
  }
  Binder& operator<<(std::span<const std::byte> bytes) {
    constexpr std::size_t largest = std::numeric_limits<int>::max();
    if (bytes.size() > largest) throw core::InputError("images of 2 GiB or more cannot be stored");
    // SQLite treats a null pointer as NULL, so an empty blob needs a pointer that is not null.
    const void* data = bytes.empty() ? static_cast<const void*>("") : bytes.data();
    statement_.bind(++index_, data, static_cast<int>(bytes.size()));
    return *this;
  }

 private:
  SQLite::Statement& statement_;
  int index_ = 0;
};

// Reads the columns of a row in the order of the query.
class Reader {
 public:
  explicit Reader(SQLite::Statement& row) : row_(row) {}

  Reader& operator>>(std::string& text) {
    const SQLite::Column column = row_.getColumn(index_++);
    // The size is limited, because parsing a string and computing its seal (a hash that detects
    // changed values) need several times as much memory as the string itself.
    constexpr int most = 64 << 20;
    if (column.getBytes() > most) {
      throw core::InputError(fmt::format("contains a string of {} bytes; the limit is {} bytes",
                                         column.getBytes(), most));
    }
    text = column.getString();
    return *this;
  }
  Reader& operator>>(double& number) {
    const SQLite::Column column = row_.getColumn(index_++);
    number = column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
    return *this;
  }
  Reader& operator>>(bool& flag) {
    flag = row_.getColumn(index_++).getInt() != 0;
    return *this;
  }
  Reader& operator>>(int& number) {
    number = row_.getColumn(index_++).getInt();
    return *this;
  }
  Reader& operator>>(std::uint64_t& number) {
    number = static_cast<std::uint64_t>(row_.getColumn(index_++).getInt64());
    return *this;
  }
  Reader& operator>>(std::vector<std::byte>& bytes) {
    const SQLite::Column column = row_.getColumn(index_++);
    const auto* data = static_cast<const std::byte*>(column.getBlob());
    bytes.assign(data, data + column.getBytes());
    return *this;
  }

 private:
  SQLite::Statement& row_;
  int index_ = 0;
};

template <typename... Values>
SQLite::Statement prepared(const SQLite::Database& database, const std::string& sql,
                           const Values&... values) {
  SQLite::Statement statement(database, sql);
  Binder binder(statement);
  (binder << ... << values);
  return statement;
}

template <typename... Values>
void execute(const SQLite::Database& database, const std::string& sql, const Values&... values) {
  SQLite::Statement statement = prepared(database, sql, values...);
  while (statement.executeStep()) {
  }
}

// Inserts the map as rows of (owner, name, value).
template <typename Value>
void insert_map(const SQLite::Database& database, std::string_view table, std::int64_t owner,
                const std::map<std::string, Value>& map) {
  if (map.empty()) return;
  SQLite::Statement insert(database, fmt::format("INSERT INTO {} VALUES (?, ?, ?)", table));
  for (const auto& [name, value] : map) {
    Binder(insert) << owner << name << value;
    insert.exec();
    insert.reset();
  }
}

}  // namespace triptych::record
