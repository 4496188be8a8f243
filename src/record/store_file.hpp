#pragma once
// The file under a Store: opening it, its schema, and what SQLite's errors mean to our callers.

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

// A connection to a file that is a store of our schema version; errors as Store's constructor has
// them.
[[nodiscard]] SQLite::Database open_store_file(const std::filesystem::path& file, Store::Mode mode,
                                               std::chrono::milliseconds busy_limit);

// A connection to a store under way that nobody else sees, its tables made where there are none. It
// has no log and waits for no disk: where anything fails, the file is to be removed. Throws
// SQLite::Exception, as the file goes by a name that nobody asked for.
[[nodiscard]] SQLite::Database open_new_store_file(const std::filesystem::path& file);

// Throws IoError when the name no longer leads to the file that was opened under it, or the log
// that holds what was added last is gone.
void require_file(const std::filesystem::path& file, SQLite::Database& database);

// Throws IoError or InputError for an error of SQLite on `file`.
[[noreturn]] void throw_store_error(const std::filesystem::path& file,
                                    const SQLite::Exception& error);

[[noreturn]] void throw_damaged(const std::filesystem::path& file, std::string_view what);

// Runs `action`, its SQLite errors turned into ours, and those of whatever reads the columns.
template <typename Action>
decltype(auto) on_store(const std::filesystem::path& file, Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const SQLite::Exception& error) {
    throw_store_error(file, error);
  } catch (const core::Json::exception& error) {
    throw_damaged(file, error.what());
  } catch (const std::out_of_range& error) {  // rows of a record that an index does not lead to
    throw_damaged(file, error.what());
  } catch (const core::InputError& error) {  // what a row says, which knows no file
    if (!error.place().file.empty()) throw;
    throw_damaged(file, error.what());
  }
}

}  // namespace triptych::record
