// Writes records to the tables that docs/store.md describes, and reads them.

#include "record/store_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "record/store_seal.hpp"
#include "record/store_values.hpp"

namespace triptych::record {
namespace {

// The columns of the table `record`, in the order in which they are written and read. The derived
// columns (clock, frames, medians) are computed from a record. They are written for users' queries
// but never read.
constexpr std::string_view record_columns =
    "run, suite, plan, configuration, scene, technique, device, outcome, cause, stage, "
    "numbers, subject, code, not_tried, shared_levels, detail, last_words, injected, "
    "device_clock_trusted, warm_up_frames, frames_per_100ms, loop_wall_ns, loop_frames, "
    "prepare_ns, overhead_ns, peak_memory_bytes, image, data_hash, kernel_hash, counted_by, "
    "benchmark_json, seal";
constexpr std::string_view derived_columns =
    "clock, frames, median_ns, median_wall_ns, median_device_ns";

std::optional<double> median(const std::vector<double>& samples) {
  const std::optional<Summary> summary = summarise(samples);
  if (!summary) return std::nullopt;
  return summary->median;
}

std::string numbers_text(const Reason& reason) {
  return reason.numbers.empty() ? "{}" : core::json_text(core::Json(reason).at("numbers"));
}

// Parses the numbers of a reason. Numbers that are not finite are stored as strings.
std::map<std::string, double> numbers_of(const std::string& text) {
  return core::Json{{"numbers", core::Json::parse(text)}}.get<Reason>().numbers;
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
          name_of(r.outcome), name_of(r.reason.cause), name_of(r.reason.stage),
          numbers_text(r.reason), r.reason.subject, r.reason.code, r.reason.not_tried,
          r.reason.shared_levels, r.reason.detail, r.reason.last_output, r.injected,
          r.device_clock_trusted, r.warm_up_frames, r.frames_per_100ms, r.loop_wall_ns,
          r.loop_frames, r.prepare_ns, r.overhead_ns, r.peak_memory_bytes, r.image, r.data_hash,
          r.kernel_hash, r.counted_by, r.benchmark_json, seal_of(r),  //
          r.clock(), r.time_ns().size(), median(r.time_ns()), median(r.wall_ns),
          median(r.device_ns));
  return database.getLastInsertRowid();
}

// The columns of the table `record` that are not part of a Record.
struct Row {
  std::int64_t seq = 0;
  std::string seal;
};

void read_row(SQLite::Statement& row, Row& extra, Record& r) {
  std::uint64_t number = 0;
  std::string outcome_name;
  std::string cause_name;
  std::string stage_name;
  std::string numbers;
  Reader reader(row);
  reader >> number >> r.run >> r.suite >> r.plan >> r.configuration >> r.scene >> r.technique >>
      r.device >> outcome_name >> cause_name >> stage_name >> numbers >> r.reason.subject >>
      r.reason.code >> r.reason.not_tried >> r.reason.shared_levels >> r.reason.detail >>
      r.reason.last_output >> r.injected >> r.device_clock_trusted >> r.warm_up_frames >>
      r.frames_per_100ms >> r.loop_wall_ns >> r.loop_frames >> r.prepare_ns >> r.overhead_ns >>
      r.peak_memory_bytes >> r.image >> r.data_hash >> r.kernel_hash >> r.counted_by >>
      r.benchmark_json >> extra.seal;
  extra.seq = static_cast<std::int64_t>(number);
  r.outcome = outcome(outcome_name);
  r.reason.cause = cause(cause_name);
  r.reason.stage = stage(stage_name);
  if (numbers != "{}") r.reason.numbers = numbers_of(numbers);
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

using RecordsBySeq = std::unordered_map<std::int64_t, Record*>;

// Calls `read(record, row)` for every row that a table contains for the records of the run. The
// first column of the table refers to the record; `columns` lists the columns to read.
template <typename Read>
void read_rows(const SQLite::Database& database, std::string_view table, std::string_view columns,
               std::string_view order, std::string_view run, const RecordsBySeq& records,
               const Read& read) {
  SQLite::Statement rows = prepared(
      database,
      fmt::format("SELECT t.record, {} FROM record r JOIN {} t ON t.record = r.seq WHERE r.run = ? "
                  "ORDER BY {}",
                  columns, table, order),
      run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    Reader reader(rows);
    reader >> seq;
    read(*records.at(static_cast<std::int64_t>(seq)), reader);
  }
}

template <typename Value>
void read_map(const SQLite::Database& database, std::string_view table, std::string_view run,
              const RecordsBySeq& records, std::map<std::string, Value> Record::*map) {
  read_rows(database, table, "t.name, t.value", "t.record", run, records,
            [map](Record& record, Reader& row) {
              std::string name;
              row >> name;
              row >> (record.*map)[name];
            });
}

void read_times(const SQLite::Database& database, std::string_view run,
                const RecordsBySeq& records) {
  read_rows(database, "sample", "t.clock, t.ns", "t.record, t.clock, t.frame", run, records,
            [](Record& record, Reader& row) {
              std::string clock;
              double ns = 0;
              row >> clock >> ns;
              (clock == "device" ? record.device_ns : record.wall_ns).push_back(ns);
            });
}

// Reads the compilers' reports of all records.
void read_code(const SQLite::Database& database, std::string_view run,
               const RecordsBySeq& records) {
  read_rows(database, "executable", "t.name, t.assembly", "t.record", run, records,
            [](Record& record, Reader& row) {
              std::string name;
              row >> name;
              row >> record.code[name].assembly;
            });
  read_rows(database, "code", "t.executable, t.name, t.value", "t.record", run, records,
            [](Record& record, Reader& row) {
              std::string executable;
              std::string name;
              row >> executable >> name;
              row >> record.code[executable].statistics[name];
            });
}

void insert_code(const SQLite::Database& database, std::int64_t record, const Code& code) {
  for (const auto& [executable, what] : code) {
    execute(database, "INSERT INTO executable VALUES (?, ?, ?)", record, executable, what.assembly);
    for (const auto& [name, value] : what.statistics) {
      execute(database, "INSERT INTO code VALUES (?, ?, ?, ?)", record, executable, name, value);
    }
  }
}

void require_record_seal(const Row& row, const Record& record) {
  require_seal(row.seal, seal_of(record),
               fmt::format("the record for {} on {}", record.configuration, record.device));
}

// Reads the rows that belong to a record from a table other than `record`, with a statement that is
// prepared only once.
class RecordRows {
 public:
  RecordRows(const SQLite::Database& database, std::string_view table, std::string_view columns,
             std::string_view order)
      : rows_(database, fmt::format("SELECT {} FROM {} WHERE record = ? ORDER BY {}", columns,
                                    table, order)) {}
  template <typename Read>
  void each(std::int64_t record, const Read& read) {
    rows_.reset();
    rows_.bind(1, record);
    while (rows_.executeStep()) {
      Reader reader(rows_);
      read(reader);
    }
  }

 private:
  SQLite::Statement rows_;
};

// Reads the parts of a record that are stored in tables other than `record`.
class RecordParts {
 public:
  explicit RecordParts(const SQLite::Database& database)
      : database_(database),
        samples_(database, "sample", "clock, ns", "clock, frame"),
        executables_(database, "executable", "name, assembly", "name"),
        code_(database, "code", "executable, name, value", "executable, name"),
        same_as_(database, "same_as", "configuration", "record") {}

  void read(std::int64_t record, Record& r) {
    samples_.each(record, [&](Reader& row) {
      std::string clock;
      double ns = 0;
      row >> clock >> ns;
      (clock == "device" ? r.device_ns : r.wall_ns).push_back(ns);
    });
    read_map("factor", record, r.factors);
    read_map("counter", record, r.counters);
    read_map("cost", record, r.cost);
    read_map("prepare_cost", record, r.prepare_cost);
    read_map("memory", record, r.memory);
    read_map("energy", record, r.energy);
    read_map("statistic", record, r.statistics);
    read_map("precision", record, r.precision);
    executables_.each(record, [&](Reader& row) {
      std::string name;
      row >> name;
      row >> r.code[name].assembly;
    });
    code_.each(record, [&](Reader& row) {
      std::string executable;
      std::string name;
      row >> executable >> name;
      row >> r.code[executable].statistics[name];
    });
    same_as_.each(record, [&](Reader& row) { row >> r.same_as; });
  }

 private:
  template <typename Value>
  void read_map(const std::string& table, std::int64_t record, std::map<std::string, Value>& map) {
    const auto rows = maps_.try_emplace(table, database_, table, "name, value", "name").first;
    rows->second.each(record, [&](Reader& row) {
      std::string name;
      row >> name;
      row >> map[name];
    });
  }

  const SQLite::Database& database_;
  RecordRows samples_, executables_, code_, same_as_;
  std::map<std::string, RecordRows> maps_;
};

}  // namespace

void insert_record(const SQLite::Database& database, const Record& r) {
  const std::int64_t seq = insert_row(database, r);
  insert_samples(database, seq, "wall", r.wall_ns);
  insert_samples(database, seq, "device", r.device_ns);
  insert_map(database, "factor", seq, r.factors);
  insert_map(database, "counter", seq, r.counters);
  insert_map(database, "cost", seq, r.cost);
  insert_map(database, "prepare_cost", seq, r.prepare_cost);
  insert_map(database, "memory", seq, r.memory);
  insert_map(database, "energy", seq, r.energy);
  insert_map(database, "statistic", seq, r.statistics);
  insert_map(database, "precision", seq, r.precision);
  insert_code(database, seq, r.code);
  if (!r.same_as.empty()) execute(database, "INSERT INTO same_as VALUES (?, ?)", seq, r.same_as);
}

std::vector<Record> read_records(const SQLite::Database& database, std::string_view run) {
  std::vector<Record> records;
  std::vector<Row> extras;
  SQLite::Statement rows = prepared(
      database,
      fmt::format("SELECT seq, {} FROM record WHERE run = ? ORDER BY device, seq", record_columns),
      run);
  while (rows.executeStep()) read_row(rows, extras.emplace_back(), records.emplace_back());
  RecordsBySeq by_seq;
  for (std::size_t i = 0; i < records.size(); ++i) by_seq[extras[i].seq] = &records[i];
  read_times(database, run, by_seq);
  read_map(database, "factor", run, by_seq, &Record::factors);
  read_map(database, "counter", run, by_seq, &Record::counters);
  read_map(database, "cost", run, by_seq, &Record::cost);
  read_map(database, "prepare_cost", run, by_seq, &Record::prepare_cost);
  read_map(database, "memory", run, by_seq, &Record::memory);
  read_map(database, "energy", run, by_seq, &Record::energy);
  read_map(database, "statistic", run, by_seq, &Record::statistics);
  read_map(database, "precision", run, by_seq, &Record::precision);
  read_code(database, run, by_seq);
  read_rows(database, "same_as", "t.configuration", "t.record", run, by_seq,
            [](Record& record, Reader& row) { row >> record.same_as; });
  for (std::size_t i = 0; i < records.size(); ++i) require_record_seal(extras[i], records[i]);
  return records;
}

void visit_records(const SQLite::Database& database, std::string_view run,
                   const std::function<void(const Record&)>& visit) {
  RecordParts parts(database);
  SQLite::Statement rows = prepared(
      database,
      fmt::format("SELECT seq, {} FROM record WHERE run = ? ORDER BY seq", record_columns), run);
  while (rows.executeStep()) {
    Row extra;
    Record record;
    read_row(rows, extra, record);
    parts.read(extra.seq, record);
    require_record_seal(extra, record);
    visit(record);
  }
}

}  // namespace triptych::record
