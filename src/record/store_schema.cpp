#include "record/store_schema.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "record/store.hpp"

namespace triptych::record {
namespace {

constexpr int application_id = 0x54524950;  // "TRIP": distinguishes a store from other SQLite files

// docs/store.md explains the tables. STRICT makes SQLite reject values of the wrong type that other
// programs may write to the store. NaN is stored as NULL, because SQLite cannot store NaN.
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
  begun TEXT NOT NULL,
  planned_hash TEXT NOT NULL,
  seal TEXT NOT NULL
) STRICT;
CREATE INDEX run_of_plan ON run (plan, seq);
CREATE TABLE planned (
  run TEXT NOT NULL REFERENCES run (id) ON DELETE CASCADE,
  configuration TEXT NOT NULL,
  PRIMARY KEY (run, configuration)
) STRICT, WITHOUT ROWID;

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
  compiles_for TEXT NOT NULL,
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
  cause TEXT NOT NULL,
  stage TEXT NOT NULL,
  numbers TEXT NOT NULL,
  subject TEXT NOT NULL,
  code TEXT NOT NULL,
  not_tried INTEGER NOT NULL,
  shared_levels TEXT NOT NULL,
  detail TEXT NOT NULL,
  last_words TEXT NOT NULL,
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

CREATE TABLE executable (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  name TEXT NOT NULL,
  assembly TEXT NOT NULL,
  PRIMARY KEY (record, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE code (
  record INTEGER NOT NULL REFERENCES record (seq) ON DELETE CASCADE,
  executable TEXT NOT NULL,
  name TEXT NOT NULL,
  value REAL,
  PRIMARY KEY (record, executable, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE listing (
  hash TEXT PRIMARY KEY,
  text TEXT NOT NULL,
  seal TEXT NOT NULL
) STRICT;
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
  own_seal TEXT NOT NULL,
  seal TEXT NOT NULL,
  PRIMARY KEY (scene, version)
) STRICT;

CREATE TABLE statistics_calibration (
  device INTEGER NOT NULL REFERENCES device (seq) ON DELETE CASCADE,
  statistic TEXT NOT NULL,
  worth TEXT NOT NULL,
  low REAL,
  high REAL,
  counter TEXT NOT NULL,
  detail TEXT NOT NULL,
  PRIMARY KEY (device, statistic)
) STRICT, WITHOUT ROWID;
CREATE TABLE device_fault (
  seq INTEGER PRIMARY KEY,
  device INTEGER NOT NULL REFERENCES device (seq) ON DELETE CASCADE,
  kind TEXT NOT NULL,
  subject TEXT NOT NULL,
  detail TEXT NOT NULL,
  last_words TEXT NOT NULL
) STRICT;
CREATE INDEX device_fault_of_device ON device_fault (device);
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

// The SQL statements that create the objects of a database, by type and name of the object.
using Objects = std::map<std::pair<std::string, std::string>, std::string>;

Objects objects_of(const SQLite::Database& database) {
  Objects objects;
  // Objects without a statement are skipped, because they are indexes that SQLite itself creates
  // for keys.
  SQLite::Statement rows(database,
                         "SELECT type, name, sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (rows.executeStep()) {
    objects[{rows.getColumn(0).getString(), rows.getColumn(1).getString()}] =
        rows.getColumn(2).getString();
  }
  return objects;
}

const Objects& expected_objects() {
  static const Objects objects = [] {
    SQLite::Database memory(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    memory.exec(schema);
    return objects_of(memory);
  }();
  return objects;
}

// Rejects a store whose objects could falsify data: a trigger could change new rows, and a view or
// a modified table could return wrong rows. Additional tables are allowed.
void require_expected_objects(const SQLite::Database& database, const std::filesystem::path& file) {
  const Objects found = objects_of(database);
  for (const auto& [object, statement] : expected_objects()) {
    const auto known = found.find(object);
    if (known != found.end() && known->second == statement) continue;
    throw core::InputError(
        {.file = file.string()},
        fmt::format(
            "the {} {} is {}; measure again and store the results in another file", object.first,
            object.second,
            known == found.end() ? "missing" : "different from the one that Triptych creates"));
  }
  for (const auto& [object, statement] : found) {
    if (object.first == "table" || expected_objects().contains(object)) continue;
    throw core::InputError({.file = file.string()},
                           fmt::format("contains the {} {}, which Triptych did not create; it "
                                       "could alter data on reading or inserting, so remove it",
                                       object.first, object.second));
  }
}

}  // namespace

bool is_blank(const SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT count(*) FROM sqlite_schema");
  query.executeStep();
  return query.getColumn(0).getInt() == 0 && pragma(database, "application_id") == 0 &&
         pragma(database, "user_version") == 0;
}

void require_expected_schema(const SQLite::Database& database, const std::filesystem::path& file) {
  if (pragma(database, "application_id") != application_id) {
    throw core::InputError(
        {.file = file.string()},
        is_blank(database) ? "is empty, so it is not a Triptych store; 'triptych run' creates one"
                           : "is an SQLite file, but not a Triptych store");
  }
  const int found = pragma(database, "user_version");
  if (found == Store::schema_version) return require_expected_objects(database, file);
  throw core::InputError(
      {.file = file.string()},
      fmt::format("the store has schema version {}, but this version of Triptych requires schema "
                  "version {}; {}, or choose another file with --store",
                  found, Store::schema_version,
                  found > Store::schema_version
                      ? "use the newer version of Triptych that wrote it"
                      : "measure again, or use the older version of Triptych"));
}

// Two processes may open the same empty file at the same time. The second process waits for the
// lock and then finds that the tables exist.
void create_schema(SQLite::Database& database) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
  if (!is_blank(database)) return;
  database.exec(schema);
  database.exec(fmt::format("PRAGMA application_id = {}", application_id));
  database.exec(fmt::format("PRAGMA user_version = {}", Store::schema_version));
  transaction.commit();
}

}  // namespace triptych::record
