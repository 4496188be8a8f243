#pragma once
// Creates and checks the tables of a store. Only store_file.cpp uses this file. All functions throw
// SQLite::Exception.

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>

namespace triptych::record {

// Returns whether the database is still empty.
[[nodiscard]] bool is_blank(const SQLite::Database& database);

// Creates the tables, unless another process has created them in the meantime.
void create_schema(SQLite::Database& database);

// Throws InputError if the file is not a store, or has another schema version.
void require_expected_schema(const SQLite::Database& database, const std::filesystem::path& file);

}  // namespace triptych::record
