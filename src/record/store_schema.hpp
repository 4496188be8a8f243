#pragma once
// The tables of a store. Used by store_file.cpp alone; all throw SQLite::Exception.

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace triptych::record {

// Whether nobody has written anything into the file.
[[nodiscard]] bool is_blank(const SQLite::Database& database);

// Makes the tables, unless another process has made them meanwhile.
void create_schema(SQLite::Database& database);

// Throws InputError where the file is no store, or of another schema version.
void require_our_schema(const SQLite::Database& database, const std::filesystem::path& file);

}  // namespace triptych::record
