#pragma once
// The file of a Store: opening it, creating its tables, and translating SQLite's errors for
// callers.

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

// Connects to a file that is a store of this program's schema version. Throws the errors that are
// described at the constructor of Store.
[[nodiscard]] SQLite::Database open_store_file(const std::filesystem::path& file, Store::Mode mode,
                                               std::chrono::milliseconds busy_limit);

// Connects to a store that is still being written and that nobody else uses yet. Creates its tables
// if there are none. The store has no log and does not wait for the disk, so the file must be
// removed after any failure. Throws SQLite::Exception but no InputError, because the user did not
// choose the name of this file.
[[nodiscard]] SQLite::Database open_new_store_file(const std::filesystem::path& file);

// Throws IoError if the name no longer belongs to the file that was opened, or if the log with the
// latest changes is gone.
void require_file(const std::filesystem::path& file, SQLite::Database& database);

// Throws IoError or InputError for an error of SQLite with `file`.
[[noreturn]] void throw_store_error(const std::filesystem::path& file,
                                    const SQLite::Exception& error);

[[noreturn]] void throw_damaged(const std::filesystem::path& file, std::string_view what);

// Runs `action` and converts errors of SQLite, and errors in reading columns, to those of this
// project.
template <typename Action>
decltype(auto) on_store(const std::filesystem::path& file, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const SQLite::Exception& error) {
    throw_store_error(file, error);
  } catch (const core::Json::exception& error) {
    throw_damaged(file, error.what());
  } catch (const std::out_of_range& error) {  // an index leads to no row of the record
    throw_damaged(file, error.what());
  } catch (const core::InputError& error) {  // a malformed row; the error names no file
    if (!error.place().file.empty()) throw;
    throw_damaged(file, error.what());
  }
}

}  // namespace triptych::record
