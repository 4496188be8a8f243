#include "record/store_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/error.hpp"

namespace triptych::record {
namespace {

constexpr int application_id = 0x54524950;  // "TRIP": tells a store from other SQLite files

// A connection is used by one thread at a time: it needs no lock around every value.
constexpr int one_thread = SQLITE_OPEN_NOMUTEX;

// docs/store.md explains the tables. STRICT keeps a column to its type for whoever else writes
// here. A number that is NaN is kept as NULL, which is what SQLite makes of it.
constexpr const char* schema = R"sql(
CREATE TABLE run (
  seq INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  plan TEXT NOT NULL,
  started_at TEXT NOT NULL,
  system TEXT NOT NULL,
  checks TEXT NOT NULL,
  plan_hash TEXT NOT NULL,
  configurations INTEGER NOT NULL,
  seal TEXT NOT NULL
) STRICT;
CREATE INDEX run_of_plan ON run (plan, seq);

CREATE TABLE device (
  seq INTEGER PRIMARY KEY,
  run TEXT NOT NULL REFERENCES run (id) ON DELETE CASCADE,
  id TEXT NOT NULL,
  api TEXT NOT NULL,
  name TEXT NOT NULL,
  vendor TEXT NOT NULL,
  driver TEXT NOT NULL,
  driver_version TEXT NOT NULL,
  api_version TEXT NOT NULL,
  cpu_features TEXT NOT NULL,
  key TEXT NOT NULL,
  key_hash TEXT NOT NULL,
  environment TEXT NOT NULL,
  limits TEXT NOT NULL,
  seal TEXT NOT NULL,
  UNIQUE (run, id)
) STRICT;

CREATE TABLE clock (
  seq INTEGER PRIMARY KEY,
  device INTEGER NOT NULL REFERENCES device (seq) ON DELETE CASCADE,
  work TEXT NOT NULL,
  offered INTEGER NOT NULL,
  trusted INTEGER NOT NULL,
  ratio REAL,
  ratio_low REAL,
  ratio_high REAL,
  verdict TEXT NOT NULL
) STRICT;
CREATE INDEX clock_of_device ON clock (device);

CREATE TABLE record (
  seq INTEGER PRIMARY KEY,
  run TEXT NOT NULL REFERENCES run (id) ON DELETE CASCADE,
  suite TEXT NOT NULL,
  plan TEXT NOT NULL,
  configuration TEXT NOT NULL,
  scene TEXT NOT NULL,
  technique TEXT NOT NULL,
  device TEXT NOT NULL,
  outcome TEXT NOT NULL,
  reason TEXT NOT NULL,
  injected TEXT NOT NULL,
  clock TEXT NOT NULL,
  frames INTEGER NOT NULL,
  median_ns REAL,
  median_wall_ns REAL,
  median_device_ns REAL,
  device_clock_trusted INTEGER NOT NULL,
  warm_up_frames INTEGER NOT NULL,
  frames_per_100ms INTEGER NOT NULL,
  loop_wall_ns REAL,
  loop_frames INTEGER NOT NULL,
  prepare_ns REAL,
  overhead_ns REAL,
  peak_memory_bytes INTEGER NOT NULL,
  image TEXT NOT NULL,
  data_hash TEXT NOT NULL,
  kernel_hash TEXT NOT NULL,
  counted_by TEXT NOT NULL,
  benchmark_json TEXT NOT NULL,
  seal TEXT NOT NULL,
  UNIQUE (run, configuration, device)
) STRICT;

CREATE TABLE sample (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  clock TEXT NOT NULL,
  frame INTEGER NOT NULL,
  ns REAL,
  PRIMARY KEY (record, clock, frame)
) STRICT, WITHOUT ROWID;
CREATE TABLE factor (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE counter (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE cost (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE prepare_cost (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE memory (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE energy (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE statistic (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value INTEGER NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE precision (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  value REAL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE image (
  hash TEXT PRIMARY KEY,
  exr BLOB NOT NULL,
  seal TEXT NOT NULL
) STRICT;
CREATE TABLE truth (
  scene TEXT NOT NULL,
  version TEXT NOT NULL,
  image BLOB NOT NULL,
  bound BLOB NOT NULL,
  seal TEXT NOT NULL,
  PRIMARY KEY (scene, version)
) STRICT;

CREATE TABLE statistics_calibration (
  device INTEGER NOT NULL REFERENCES device (seq) ON DELETE CASCADE,
  statistic TEXT NOT NULL,
  verdict TEXT NOT NULL,
  PRIMARY KEY (device, statistic)
) STRICT, WITHOUT ROWID;
CREATE TABLE same_as (
  record INTEGER PRIMARY KEY REFERENCES record (seq) ON DELETE CASCADE,
  configuration TEXT NOT NULL
) STRICT;
CREATE TABLE begun (
  run TEXT NOT NULL REFERENCES run (id) ON DELETE CASCADE,
  configuration TEXT NOT NULL,
  device TEXT NOT NULL,
  times INTEGER NOT NULL,
  PRIMARY KEY (run, configuration, device)
) STRICT, WITHOUT ROWID;
)sql";

int pragma(const SQLite::Database& database, const std::string& name) {
  SQLite::Statement query(database, "PRAGMA " + name);
  query.executeStep();
  return query.getColumn(0).getInt();
}

bool is_blank(const SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT count(*) FROM sqlite_schema");
  query.executeStep();
  return query.getColumn(0).getInt() == 0 && pragma(database, "application_id") == 0 &&
         pragma(database, "user_version") == 0;
}

void require_our_schema(const SQLite::Database& database, const std::filesystem::path& file) {
  if (pragma(database, "application_id") != application_id) {
    throw core::InputError({.file = file.string()},
                           is_blank(database)
                               ? "is empty, not a Triptych store; 'triptych run' makes one"
                               : "is an SQLite file, but not a Triptych store");
  }
  const int found = pragma(database, "user_version");
  if (found == Store::schema_version) return;
  throw core::InputError(
      {.file = file.string()},
      fmt::format("store of schema version {}, but this program reads version {}: {}, or give "
                  "another file with --store",
                  found, Store::schema_version,
                  found > Store::schema_version ? "use the newer Triptych that wrote it"
                                                : "measure again, or use the older Triptych"));
}

// The log of a writer that did not close: without it the newest records would be missing unnoticed.
bool has_log(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(file.string() + "-wal", ignored);
  return !ignored && size > 0;
}

// SQLite takes ":memory:" and "file:…" for no files; what begins with a slash always is one.
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
    require_our_schema(database, file);
    return database;
  } catch (const SQLite::Exception& error) {
    const bool no_room_for_log =
        error.getErrorCode() == SQLITE_CANTOPEN || error.getErrorCode() == SQLITE_READONLY;
    if (!no_room_for_log) throw;
    if (has_log(file)) {
      throw core::IoError(fmt::format(
          "{}: its writer was stopped before closing it and its log cannot be replayed in a "
          "read-only folder; copy it together with its -wal file to a folder that can be written",
          file.string()));
    }
  }
  // A WAL file needs two files beside it even to be read; without them only a promise that nobody
  // writes lets SQLite open it. Where the folder cannot be written, that holds.
  SQLite::Database database(immutable_uri(file),
                            SQLite::OPEN_READONLY | SQLite::OPEN_URI | one_thread,
                            milliseconds_of(busy_limit));
  require_our_schema(database, file);
  return database;
}

// Two processes may find the same blank file: the second waits for the lock and finds it filled.
void create_schema(SQLite::Database& database) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
  if (!is_blank(database)) return;
  database.exec(schema);
  database.exec(fmt::format("PRAGMA application_id = {}", application_id));
  database.exec(fmt::format("PRAGMA user_version = {}", Store::schema_version));
  transaction.commit();
}

// Of processes that switch to the log at once SQLite refuses all but one immediately, busy limit or
// not, for each holds a read lock that another waits for.
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
  // SQLite opens a file that it may not write for reading, without a word.
  if (sqlite3_db_readonly(database.getHandle(), "main") == 1) {
    throw core::IoError(fmt::format("{}: is read-only; nothing can be added", file.string()));
  }
  if (is_blank(database)) create_schema(database);
  require_our_schema(database, file);
  write_ahead(database, busy_limit);
  // In WAL mode NORMAL survives the death of any process; only a loss of power may cost the last
  // transactions, and even then the file stays whole. What has to outlive that waits for the disk
  // (Store::begin_record).
  database.exec("PRAGMA synchronous = NORMAL");
  database.exec("PRAGMA foreign_keys = ON");
  return database;
}

}  // namespace

SQLite::Database open_store_file(const std::filesystem::path& file, Store::Mode mode,
                                 std::chrono::milliseconds busy_limit) {
  if (file.empty()) throw core::InputError("a store needs the name of a file");
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw core::IoError(fmt::format("{}: is a folder, not a store", file.string()));
  }
  return on_store(file, [&] {
    if (mode == Store::Mode::append) return open_to_append(file, busy_limit);
    if (!std::filesystem::exists(file, ignored)) {
      throw core::IoError(
          fmt::format("{}: there is no such file; 'triptych run' makes one", file.string()));
    }
    return open_to_read(file, busy_limit);
  });
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
  throw core::IoError(
      fmt::format("{}: was removed or renamed while it was open; what is added now would be lost",
                  lost_log ? log.string() : file.string()));
}

void throw_damaged(const std::filesystem::path& file, std::string_view what) {
  throw core::InputError(
      {.file = file.string()},
      fmt::format("is damaged ({}): measure again; 'sqlite3 FILE .recover' may save what is left",
                  what));
}

void throw_store_error(const std::filesystem::path& file, const SQLite::Exception& error) {
  const std::string name = file.string();
  const std::string_view what = error.what();
  switch (error.getErrorCode()) {
    case SQLITE_NOTADB:
      throw core::InputError({.file = name}, "is not an SQLite file, so not a Triptych store");
    case SQLITE_CORRUPT:
      throw_damaged(file, what);
    case SQLITE_FULL:
      throw core::IoError(fmt::format("{}: the disk is full; what was added before is safe", name));
    case SQLITE_READONLY:
      throw core::IoError(
          fmt::format("{}: nothing can be added, it or its folder is read-only ({})", name, what));
    case SQLITE_CANTOPEN:
      throw core::IoError(fmt::format(
          "{}: cannot be opened ({}); is its folder there, and can it be written?", name, what));
    case SQLITE_IOERR:
      throw core::IoError(fmt::format(
          "{}: cannot be read or written ({}): is the disk full, or broken?", name, what));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw core::IoError(
          fmt::format("{}: another process has kept it locked too long ({}); try again when that "
                      "one is done",
                      name, what));
    default:
      throw core::IoError(fmt::format("{}: {}", name, what));
  }
}

}  // namespace triptych::record
