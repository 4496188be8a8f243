#include "record/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "core/error.hpp"
#include "core/json.hpp"
#include "record/store_file.hpp"
#include "record/store_values.hpp"

namespace triptych::record {
namespace {

using core::Json;

// As Json prints it: text that is not UTF-8 must not stop a run (see record.hpp).
std::string text_of(const std::map<std::string, std::string>& map, const char* field,
                    const Json& owner) {
  return map.empty() ? "{}" : owner.at(field).dump();
}

std::map<std::string, std::string> map_of(const std::string& text) {
  return Json::parse(text).get<std::map<std::string, std::string>>();
}

// --- one record
// ------------------------------------------------------------------------------------------

// The same columns in the same order for writing and reading. What a record can derive (clock,
// frames, medians) is written beside them for people's queries and never read back.
constexpr std::string_view record_columns =
    "run, suite, plan, configuration, scene, technique, device, outcome, reason, planted, "
    "device_clock_trusted, warm_up_frames, frames_per_100ms, loop_wall_ns, loop_frames, "
    "prepare_ns, overhead_ns, peak_memory_bytes, image, data_hash, kernel_hash, benchmark_json";
constexpr std::string_view derived_columns =
    "clock, frames, median_ns, median_wall_ns, median_device_ns";

std::optional<double> median(const std::vector<double>& samples) {
  const std::optional<Summary> summary = summarise(samples);
  if (!summary) return std::nullopt;
  return summary->median;
}

std::int64_t insert_row(const SQLite::Database& database, const Record& r) {
  const auto columns = std::ranges::count(record_columns, ',') + 1;
  const auto derived = std::ranges::count(derived_columns, ',') + 1;
  std::string places = "?";
  for (auto i = columns + derived; i > 1; --i) places += ", ?";
  execute(database,
          fmt::format("INSERT INTO record ({}, {}) VALUES ({})", record_columns, derived_columns,
                      places),
          r.run, r.suite, r.plan, r.configuration, r.scene, r.technique, r.device,
          name_of(r.outcome), r.reason, r.planted, r.device_clock_trusted, r.warm_up_frames,
          r.frames_per_100ms, r.loop_wall_ns, r.loop_frames, r.prepare_ns, r.overhead_ns,
          r.peak_memory_bytes, r.image, r.data_hash, r.kernel_hash, r.benchmark_json,  //
          r.clock(), r.time_ns().size(), median(r.time_ns()), median(r.wall_ns),
          median(r.device_ns));
  return database.getLastInsertRowid();
}

void read_row(SQLite::Statement& row, std::int64_t& seq, Record& r) {
  std::uint64_t number = 0;
  std::string outcome_name;
  Reader reader(row);
  reader >> number >> r.run >> r.suite >> r.plan >> r.configuration >> r.scene >> r.technique >>
      r.device >> outcome_name >> r.reason >> r.planted >> r.device_clock_trusted >>
      r.warm_up_frames >> r.frames_per_100ms >> r.loop_wall_ns >> r.loop_frames >> r.prepare_ns >>
      r.overhead_ns >> r.peak_memory_bytes >> r.image >> r.data_hash >> r.kernel_hash >>
      r.benchmark_json;
  seq = static_cast<std::int64_t>(number);
  r.outcome = outcome(outcome_name);
}

// --- the tables under a record or a device
// ---------------------------------------------------------------------------

template <typename Value>
void insert_map(const SQLite::Database& database, std::string_view table, std::int64_t owner,
                const std::map<std::string, Value>& map) {
  if (map.empty()) return;
  SQLite::Statement insert(database, fmt::format("INSERT INTO {} VALUES (?, ?, ?)", table));
  for (const auto& [name, value] : map) {
    Binder(insert) << owner << name << value;
    insert.exec();
    insert.reset();
  }
}

void insert_samples(const SQLite::Database& database, std::int64_t record, std::string_view clock,
                    const std::vector<double>& samples) {
  SQLite::Statement insert(database, "INSERT INTO sample VALUES (?, ?, ?, ?)");
  for (std::size_t frame = 0; frame < samples.size(); ++frame) {
    Binder(insert) << record << clock << frame << samples[frame];
    insert.exec();
    insert.reset();
  }
}

void insert_times(const SQLite::Database& database, std::int64_t seq, const Record& r) {
  insert_samples(database, seq, "wall", r.wall_ns);
  insert_samples(database, seq, "device", r.device_ns);
  SQLite::Statement insert(database, "INSERT INTO round VALUES (?, ?, ?)");
  for (std::size_t round = 0; round < r.rounds_ns.size(); ++round) {
    Binder(insert) << seq << round << r.rounds_ns[round];
    insert.exec();
    insert.reset();
  }
}

std::int64_t seq_of(const SQLite::Database& database, const Record& r) {
  SQLite::Statement row = prepared(
      database, "SELECT seq FROM record WHERE run = ? AND configuration = ? AND device = ?", r.run,
      r.configuration, r.device);
  if (!row.executeStep()) {
    throw core::InputError(fmt::format("run {} has no record of {} on {} whose times could change",
                                       r.run, r.configuration, r.device));
  }
  return row.getColumn(0).getInt64();
}

using RecordsBySeq = std::unordered_map<std::int64_t, Record*>;

template <typename Value>
void read_map(const SQLite::Database& database, std::string_view table, std::string_view run,
              const RecordsBySeq& records, std::map<std::string, Value> Record::*map) {
  SQLite::Statement rows = prepared(
      database,
      fmt::format("SELECT t.record, t.name, t.value FROM record r JOIN {} t ON t.record = r.seq "
                  "WHERE r.run = ?",
                  table),
      run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    std::string name;
    Reader reader(rows);
    reader >> seq >> name;
    reader >> (records.at(static_cast<std::int64_t>(seq))->*map)[name];
  }
}

void read_samples(const SQLite::Database& database, std::string_view run,
                  const RecordsBySeq& records) {
  SQLite::Statement rows =
      prepared(database,
               "SELECT s.record, s.clock, s.ns FROM record r JOIN sample s ON s.record = r.seq "
               "WHERE r.run = ? ORDER BY s.record, s.clock, s.frame",
               run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    std::string clock;
    double ns = 0;
    Reader(rows) >> seq >> clock >> ns;
    Record& record = *records.at(static_cast<std::int64_t>(seq));
    (clock == "device" ? record.device_ns : record.wall_ns).push_back(ns);
  }
}

// A store that was read but never written since lacks the table: its records know no rounds.
void read_rounds(const SQLite::Database& database, std::string_view run,
                 const RecordsBySeq& records) {
  if (!database.tableExists("round")) return;
  SQLite::Statement rows =
      prepared(database,
               "SELECT t.record, t.ns FROM record r JOIN round t ON t.record = r.seq "
               "WHERE r.run = ? ORDER BY t.record, t.round",
               run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    double ns = 0;
    Reader(rows) >> seq >> ns;
    records.at(static_cast<std::int64_t>(seq))->rounds_ns.push_back(ns);
  }
}

// As of rounds.
void read_same_as(const SQLite::Database& database, std::string_view run,
                  const RecordsBySeq& records) {
  if (!database.tableExists("same_as")) return;
  SQLite::Statement rows =
      prepared(database,
               "SELECT t.record, t.configuration FROM record r JOIN same_as t ON t.record = r.seq "
               "WHERE r.run = ?",
               run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    Reader reader(rows);
    reader >> seq;
    reader >> records.at(static_cast<std::int64_t>(seq))->same_as;
  }
}

Run read_run(SQLite::Statement& row) {
  Run run;
  std::string system;
  Reader(row) >> run.id >> run.plan >> run.started_at >> system;
  run.system = map_of(system);
  return run;
}

std::vector<ClockTrust> read_clocks(const SQLite::Database& database, std::uint64_t device) {
  std::vector<ClockTrust> clocks;
  SQLite::Statement rows =
      prepared(database,
               "SELECT work, offered, trusted, ratio, ratio_low, ratio_high, verdict FROM clock "
               "WHERE device = ? ORDER BY seq",
               device);
  while (rows.executeStep()) {
    ClockTrust& c = clocks.emplace_back();
    Reader(rows) >> c.work >> c.offered >> c.trusted >> c.ratio >> c.ratio_low >> c.ratio_high >>
        c.verdict;
  }
  return clocks;
}

// A store that no newer program has added to has no such table.
std::map<std::string, std::string> read_dialect(const SQLite::Database& database,
                                                std::uint64_t device) {
  std::map<std::string, std::string> dialect;
  if (!database.tableExists("dialect")) return dialect;
  SQLite::Statement rows =
      prepared(database, "SELECT statistic, verdict FROM dialect WHERE device = ?", device);
  while (rows.executeStep()) {
    std::string statistic;
    Reader reader(rows);
    reader >> statistic;
    reader >> dialect[statistic];
  }
  return dialect;
}

}  // namespace

struct Store::State {
  std::filesystem::path file;
  SQLite::Database database;

  // All or nothing. The lock is taken at once: a reader that turned writer could not wait for it.
  template <typename Action>
  void write(Action&& action) {
    on_store(file, [&] {
      SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
      action();
      transaction.commit();
    });
  }

  void require_run(std::string_view run) const {
    SQLite::Statement row = prepared(database, "SELECT 1 FROM run WHERE id = ?", run);
    if (row.executeStep()) return;
    throw core::InputError({.file = file.string()},
                           fmt::format("run '{}' is not in the store; add it first", run));
  }
};

Store::Store(const std::filesystem::path& file, Mode mode, std::chrono::milliseconds busy_limit)
    : state_(std::make_unique<State>(State{file, open_store_file(file, mode, busy_limit)})) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

void Store::add_run(const Run& run) {
  const std::string system = text_of(run.system, "system", run);
  state_->write([&] {
    execute(state_->database,
            "INSERT INTO run (id, plan, started_at, system) VALUES (?, ?, ?, ?) "
            "ON CONFLICT (id) DO UPDATE SET plan = excluded.plan, "
            "started_at = excluded.started_at, system = excluded.system",
            run.id, run.plan, run.started_at, system);
  });
}

void Store::add_device(const std::string& run, const Device& d,
                       const std::vector<ClockTrust>& clocks) {
  const Json json = d;
  state_->write([&] {
    const SQLite::Database& database = state_->database;
    state_->require_run(run);
    execute(database, "DELETE FROM device WHERE run = ? AND id = ?", run, d.id);
    execute(database,
            "INSERT INTO device (run, id, api, name, vendor, driver, driver_version, api_version, "
            "cpu_features, key, key_hash, environment, limits) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            run, d.id, d.api, d.name, d.vendor, d.driver, d.driver_version, d.api_version,
            d.cpu_features, d.key(), d.key_hash(), text_of(d.environment, "environment", json),
            text_of(d.limits, "limits", json));
    const std::int64_t device = database.getLastInsertRowid();
    for (const ClockTrust& c : clocks) {
      execute(database,
              "INSERT INTO clock (device, work, offered, trusted, ratio, ratio_low, ratio_high, "
              "verdict) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
              device, c.work, c.offered, c.trusted, c.ratio, c.ratio_low, c.ratio_high, c.verdict);
    }
    insert_map(database, "dialect", device, d.statistics_dialect);
  });
}

void Store::add_image(std::string_view hash, std::span<const std::byte> exr) {
  state_->write([&] {
    execute(state_->database, "INSERT INTO image VALUES (?, ?) ON CONFLICT (hash) DO NOTHING", hash,
            exr);
  });
}

void Store::add_record(const Record& r) {
  state_->write([&] {
    const SQLite::Database& database = state_->database;
    state_->require_run(r.run);
    execute(database, "DELETE FROM record WHERE run = ? AND configuration = ? AND device = ?",
            r.run, r.configuration, r.device);
    const std::int64_t seq = insert_row(database, r);
    insert_times(database, seq, r);
    insert_map(database, "factor", seq, r.factors);
    insert_map(database, "counter", seq, r.counters);
    insert_map(database, "statistic", seq, r.statistics);
    insert_map(database, "precision", seq, r.precision);
    if (!r.same_as.empty()) execute(database, "INSERT INTO same_as VALUES (?, ?)", seq, r.same_as);
  });
}

void Store::update_times(const Record& r) {
  state_->write([&] {
    const SQLite::Database& database = state_->database;
    const std::int64_t seq = seq_of(database, r);
    execute(database, "DELETE FROM sample WHERE record = ?", seq);
    execute(database, "DELETE FROM round WHERE record = ?", seq);
    execute(database,
            "UPDATE record SET frames = ?, median_ns = ?, median_wall_ns = ?, median_device_ns = ? "
            "WHERE seq = ?",
            r.time_ns().size(), median(r.time_ns()), median(r.wall_ns), median(r.device_ns), seq);
    insert_times(database, seq, r);
  });
}

void Store::set_truth(const TruthImage& truth) {
  state_->write([&] {
    execute(state_->database, "INSERT OR REPLACE INTO truth VALUES (?, ?, ?, ?)", truth.scene,
            truth.version, truth.image, truth.bound);
  });
}

std::vector<Run> Store::runs() const {
  return on_store(state_->file, [&] {
    std::vector<Run> runs;
    SQLite::Statement rows(state_->database,
                           "SELECT id, plan, started_at, system FROM run ORDER BY seq");
    while (rows.executeStep()) runs.push_back(read_run(rows));
    return runs;
  });
}

std::optional<Run> Store::latest_run(std::string_view plan) const {
  return on_store(state_->file, [&]() -> std::optional<Run> {
    SQLite::Statement row = prepared(state_->database,
                                     "SELECT id, plan, started_at, system FROM run WHERE plan = ? "
                                     "ORDER BY seq DESC LIMIT 1",
                                     plan);
    if (!row.executeStep()) return std::nullopt;
    return read_run(row);
  });
}

std::vector<Store::DeviceEntry> Store::devices(std::string_view run) const {
  return on_store(state_->file, [&] {
    std::vector<DeviceEntry> entries;
    SQLite::Statement rows =
        prepared(state_->database,
                 "SELECT seq, id, api, name, vendor, driver, driver_version, api_version, "
                 "cpu_features, environment, limits FROM device WHERE run = ? ORDER BY seq",
                 run);
    while (rows.executeStep()) {
      std::uint64_t seq = 0;
      std::string environment;
      std::string limits;
      Device d;
      Reader(rows) >> seq >> d.id >> d.api >> d.name >> d.vendor >> d.driver >> d.driver_version >>
          d.api_version >> d.cpu_features >> environment >> limits;
      d.environment = map_of(environment);
      d.limits = map_of(limits);
      d.statistics_dialect = read_dialect(state_->database, seq);
      entries.push_back({std::move(d), read_clocks(state_->database, seq)});
    }
    return entries;
  });
}

std::vector<Record> Store::records(std::string_view run) const {
  return on_store(state_->file, [&] {
    // One view of the file for all queries, whoever writes meanwhile.
    const SQLite::Database& database = state_->database;
    SQLite::Transaction snapshot(state_->database, SQLite::TransactionBehavior::DEFERRED);
    std::vector<Record> records;
    std::vector<std::int64_t> seqs;
    SQLite::Statement rows =
        prepared(database,
                 fmt::format("SELECT seq, {} FROM record WHERE run = ? ORDER BY device, seq",
                             record_columns),
                 run);
    while (rows.executeStep()) read_row(rows, seqs.emplace_back(), records.emplace_back());
    RecordsBySeq by_seq;
    for (std::size_t i = 0; i < records.size(); ++i) by_seq[seqs[i]] = &records[i];
    read_samples(database, run, by_seq);
    read_rounds(database, run, by_seq);
    read_same_as(database, run, by_seq);
    read_map(database, "factor", run, by_seq, &Record::factors);
    read_map(database, "counter", run, by_seq, &Record::counters);
    read_map(database, "statistic", run, by_seq, &Record::statistics);
    read_map(database, "precision", run, by_seq, &Record::precision);
    return records;
  });
}

bool Store::has_record(std::string_view run, std::string_view configuration,
                       std::string_view device) const {
  return on_store(state_->file, [&] {
    return prepared(state_->database,
                    "SELECT 1 FROM record WHERE run = ? AND configuration = ? AND device = ?", run,
                    configuration, device)
        .executeStep();
  });
}

std::vector<std::byte> Store::image(std::string_view hash) const {
  return on_store(state_->file, [&] {
    SQLite::Statement row =
        prepared(state_->database, "SELECT exr FROM image WHERE hash = ?", hash);
    if (!row.executeStep()) {
      throw core::InputError({.file = state_->file.string()},
                             fmt::format("there is no image '{}' in the store", hash));
    }
    std::vector<std::byte> exr;
    Reader(row) >> exr;
    return exr;
  });
}

std::optional<TruthImage> Store::truth(std::string_view scene, std::string_view version) const {
  return on_store(state_->file, [&]() -> std::optional<TruthImage> {
    SQLite::Statement row =
        prepared(state_->database,
                 "SELECT scene, version, image, bound FROM truth WHERE scene = ? AND version = ?",
                 scene, version);
    if (!row.executeStep()) return std::nullopt;
    TruthImage truth;
    Reader(row) >> truth.scene >> truth.version >> truth.image >> truth.bound;
    return truth;
  });
}

}  // namespace triptych::record
