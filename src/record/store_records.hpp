#pragma once
// Records in and out of the store's tables; transactions are the caller's. Used by store.cpp alone.

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <string_view>
#include <vector>

#include "record/record.hpp"

namespace triptych::record {

// The run must be there, a record of the same run, configuration and device must not.
void insert_record(const SQLite::Database& database, const Record& record);

// Store::records.
[[nodiscard]] std::vector<Record> read_records(const SQLite::Database& database,
                                               std::string_view run);

// Store::visit_records.
void visit_records(const SQLite::Database& database, std::string_view run,
                   const std::function<void(const Record&)>& visit);

}  // namespace triptych::record
