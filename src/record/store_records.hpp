#pragma once
// Writes records to the store's tables and reads them. Callers handle the transactions. Only
// store.cpp uses this file.

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::record {

// Inserts a record. Its run must exist. A record of the same run, configuration and device must not
// exist yet.
void insert_record(const SQLite::Database& database, const Record& record);

// See Store::records.
[[nodiscard]] std::vector<Record> read_records(const SQLite::Database& database,
                                               std::string_view run);

// See Store::visit_records.
void visit_records(const SQLite::Database& database, std::string_view run,
                   const std::function<void(const Record&)>& visit);

}  // namespace triptych::record
