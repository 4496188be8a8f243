#include "record/store_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/error.hpp"
#include "record/store_schema.hpp"

namespace triptych::record {
namespace {

// Only one thread uses a connection at a time, so SQLite need not lock a mutex in every call.
constexpr int one_thread = SQLITE_OPEN_NOMUTEX;

// Returns whether there is a log left by a writer that did not close the store. If the log were
// ignored, the latest records would be missing without notice.
bool has_log(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(file.string() + "-wal", ignored);
  return !ignored && size > 0;
}

// Returns an absolute path, because names such as ":memory:" and "file:…" have a special meaning in
// SQLite. A name that begins with a slash is always a file name.
std::string file_name(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).string();
}

std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : file_name(file)) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02x}", static_cast<unsigned>(c));
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

int milliseconds_of(std::chrono::milliseconds limit) {
  return static_cast<int>(limit.count());
}

SQLite::Database open_to_read(const std::filesystem::path& file,
                              std::chrono::milliseconds busy_limit) {
  try {
    SQLite::Database database(file_name(file), SQLite::OPEN_READONLY | one_thread,
                              milliseconds_of(busy_limit));
    require_expected_schema(database, file);
    return database;
  } catch (const SQLite::Exception& error) {
    const bool no_room_for_log =
        error.getErrorCode() == SQLITE_CANTOPEN || error.getErrorCode() == SQLITE_READONLY;
    if (!no_room_for_log) throw;
    if (has_log(file)) {
      throw core::IoError(
          fmt::format("{}: the program that wrote this store was stopped before it closed the "
                      "store, and the store's log cannot be replayed in a read-only folder; copy "
                      "the store and its -wal file to a writable folder",
                      file.string()));
    }
  }
  // To read a file in WAL mode, SQLite needs two more files next to it. It cannot create them in a
  // read-only folder. There it opens the file only if the caller guarantees that nobody writes to
  // the file, which is true in such a folder.
  SQLite::Database database(immutable_uri(file),
                            SQLite::OPEN_READONLY | SQLite::OPEN_URI | one_thread,
                            milliseconds_of(busy_limit));
  require_expected_schema(database, file);
  return database;
}

// Switches to WAL mode. If several processes do this at the same time, SQLite rejects all but one
// of them immediately, regardless of the busy limit, because each process holds a read lock that
// another process is waiting for. Therefore this function retries until `busy_limit` has passed.
void write_ahead(SQLite::Database& database, std::chrono::milliseconds busy_limit) {
  const auto end = std::chrono::steady_clock::now() + busy_limit;
  for (;;) {
    try {
      database.exec("PRAGMA journal_mode = WAL");
      return;
    } catch (const SQLite::Exception& error) {
      const bool busy = error.getErrorCode() == SQLITE_BUSY;
      if (!busy || std::chrono::steady_clock::now() >= end) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

SQLite::Database open_to_append(const std::filesystem::path& file,
                                std::chrono::milliseconds busy_limit) {
  SQLite::Database database(file_name(file),
                            SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | one_thread,
                            milliseconds_of(busy_limit));
  // SQLite silently opens a read-only file for reading only.
  if (sqlite3_db_readonly(database.getHandle(), "main") == 1) {
    throw core::IoError(
        fmt::format("{}: the store is read-only, so nothing can be added to it", file.string()));
  }
  if (is_blank(database)) create_schema(database);
  require_expected_schema(database, file);
  write_ahead(database, busy_limit);
  // In WAL mode, synchronous = NORMAL keeps all data when a process dies. Only a power failure can
  // lose the latest transactions, and even then the file stays intact. Data that must survive a
  // power failure are flushed to the disk explicitly (see Store::begin_record()).
  database.exec("PRAGMA synchronous = NORMAL");
  database.exec("PRAGMA foreign_keys = ON");
  return database;
}

}  // namespace

SQLite::Database open_store_file(const std::filesystem::path& file, Store::Mode mode,
                                 std::chrono::milliseconds busy_limit) {
  if (file.empty()) throw core::InputError("the name of the store is empty; expected a file name");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw core::IoError(fmt::format("{}: is a folder, not a store", file.string()));
  }
  return on_store(file, [&] {
    if (mode == Store::Mode::append) return open_to_append(file, busy_limit);
    if (!std::filesystem::exists(file, ignored)) {
      throw core::IoError(
          fmt::format("{}: there is no such file; 'triptych run' creates one", file.string()));
    }
    return open_to_read(file, busy_limit);
  });
}

SQLite::Database open_new_store_file(const std::filesystem::path& file) {
  SQLite::Database database(file_name(file),
                            SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | one_thread);
  for (const char* pragma : {"journal_mode = OFF", "synchronous = OFF", "locking_mode = EXCLUSIVE",
                             "foreign_keys = OFF"}) {
    database.exec(std::string("PRAGMA ") + pragma);
  }
  if (is_blank(database)) create_schema(database);
  return database;
}

void require_file(const std::filesystem::path& file, SQLite::Database& database) {
  int moved = 0;
  const int answer =
      sqlite3_file_control(database.getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  std::error_code ignored;
  const std::filesystem::path log = file.string() + "-wal";
  const bool lost_log = !std::filesystem::exists(log, ignored) &&
                        database.execAndGet("PRAGMA journal_mode").getString() == "wal";
  if (!lost_log && (answer != SQLITE_OK || moved == 0)) return;
  throw core::IoError(fmt::format(
      "{}: was removed or renamed while it was open; data added from now on would be lost",
      lost_log ? log.string() : file.string()));
}

void throw_damaged(const std::filesystem::path& file, std::string_view what) {
  throw core::InputError(
      {.file = file.string()},
      fmt::format("is damaged ({}); measure again, or try to recover the remaining data with "
                  "'sqlite3 FILE .recover'",
                  what));
}

void throw_store_error(const std::filesystem::path& file, const SQLite::Exception& error) {
  const std::string name = file.string();
  const std::string_view what = error.what();
  switch (error.getErrorCode()) {
    case SQLITE_NOTADB:
      throw core::InputError({.file = name},
                             "is not an SQLite file, so it is not a Triptych store");
    case SQLITE_CORRUPT:
      throw_damaged(file, what);
    case SQLITE_FULL:
      throw core::IoError(
          fmt::format("{}: the disk is full; the data added so far are intact", name));
    case SQLITE_READONLY:
      throw core::IoError(fmt::format(
          "{}: cannot be written, because the file or its folder is read-only ({})", name, what));
    case SQLITE_CANTOPEN:
      throw core::IoError(fmt::format(
          "{}: cannot be opened ({}); check that its folder exists and is writable", name, what));
    case SQLITE_IOERR:
      throw core::IoError(fmt::format(
          "{}: cannot be read or written ({}); check whether the disk is full or broken", name,
          what));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw core::IoError(
          fmt::format("{}: gave up waiting for the lock on the store, which another process holds "
                      "({}); try again when "
                      "that process has finished",
                      name, what));
    default:
      throw core::IoError(fmt::format("{}: {}", name, what));
  }
}

}  // namespace triptych::record
