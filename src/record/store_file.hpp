#pragma once
// Opens the file of a Store, creates its tables, and converts SQLite errors to this project's error
// types.

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/json.hpp"
#include "record/store.hpp"

namespace triptych::record {

// Opens a store, which must have this program's schema version. Throws the same exceptions as the
// constructor of Store.
[[nodiscard]] SQLite::Database open_store_file(const std::filesystem::path& file, Store::Mode mode,
                                               std::chrono::milliseconds busy_limit);

// Opens a file that is to become a store and that no other process uses yet. Creates the tables if
// the file is empty. Changes are neither logged nor flushed to the disk, so the file must be
// removed after any failure. Throws SQLite::Exception but no InputError, because the user did not
// choose the name of this file.
[[nodiscard]] SQLite::Database open_new_store_file(const std::filesystem::path& file);

// Throws IoError if the path no longer refers to the file that was opened, or if the log with the
// latest changes is gone.
void require_file(const std::filesystem::path& file, SQLite::Database& database);

// Converts an SQLite error to an IoError or InputError that names `file`, and throws it.
[[noreturn]] void throw_store_error(const std::filesystem::path& file,
                                    const SQLite::Exception& error);

[[noreturn]] void throw_damaged(const std::filesystem::path& file, std::string_view what);

// Runs `action`. Converts SQLite errors, and errors in the content of columns, to this project's
// error types.
template <typename Action>
decltype(auto) on_store(const std::filesystem::path& file, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const SQLite::Exception& error) {
    throw_store_error(file, error);
  } catch (const core::Json::exception& error) {
    throw_damaged(file, error.what());
  } catch (const std::out_of_range& error) {  // a row refers to a record that does not exist
    throw_damaged(file, error.what());
  } catch (const core::InputError& error) {  // an invalid value; the error does not name a file
    if (!error.place().file.empty()) throw;
    throw_damaged(file, error.what());
  }
}

}  // namespace triptych::record
