#include "record/merge/record_copy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <future>
#include <utility>

#include "core/error.hpp"
#include "record/data_factors.hpp"
#include "record/store_file.hpp"

namespace triptych::record {
namespace {

// The columns that the merge itself evaluates. Queries select them before all other columns.
constexpr std::array<std::string_view, 8> named_columns{
    "configuration", "device", "outcome", "injected", "seal", "data_hash", "suite", "seq"};
namespace column {
enum : int { configuration, device, outcome, injected, seal, data_hash, suite, seq };
}

std::vector<std::string> texts(const SQLite::Database& database, const std::string& sql) {
  std::vector<std::string> result;
  Query rows(database, sql);
  while (rows.step()) result.emplace_back(rows.text(0));
  return result;
}

std::vector<std::string> other_columns(const SQLite::Database& database) {
  std::vector<std::string> columns =
      texts(database, "SELECT name FROM pragma_table_info('record')");
  std::erase_if(columns, [](const std::string& each) {
    return each == "run" || std::ranges::find(named_columns, each) != named_columns.end();
  });
  return columns;
}

// Returns the columns in the order in which they are written: seq, run, and then all other columns
// in the order in which they are read.
std::vector<std::string> columns_with(const std::vector<std::string>& others) {
  std::vector<std::string> columns{"seq", "run"};
  columns.insert(columns.end(), named_columns.begin(), named_columns.end() - 1);
  columns.insert(columns.end(), others.begin(), others.end());
  return columns;
}

int rank_of(std::string_view outcome) {
  if (outcome == "measured") return 0;
  return outcome == "skipped" ? 1 : 2;
}

bool has_fault(const Query& record) {
  return !record.text(column::injected).empty();
}

// Returns whether record `a` is preferred to record `b`. A record without an injected fault is
// preferred to a record with an injected fault, even if only the latter was measured. Otherwise, a
// measured record is preferred, because users repeat jobs in order to measure what failed before.
// The last rule, which prefers the smaller seal (hash), is arbitrary, but it does not depend on the
// order of the stores.
bool is_before(const Query& a, const Query& b) {
  if (has_fault(a) != has_fault(b)) return has_fault(b);
  const int rank_a = rank_of(a.text(column::outcome));
  const int rank_b = rank_of(b.text(column::outcome));
  return rank_a != rank_b ? rank_a < rank_b : a.text(column::seal) < b.text(column::seal);
}

// Adds the factors of a record to `rows`. Returns those factors that determine the content of the
// record's data.
std::string add_factors(RowBatch& rows, Query& factors, std::int64_t record) {
  std::string data;
  while (factors.step()) {
    rows.add(record);
    rows.add(factors, 0, 2);
    const std::string_view name = factors.text(0);
    if (!determines_data(name)) continue;
    data.append(" ").append(name).append("=").append(factors.text(1));
  }
  return data;
}

}  // namespace

void DataHashes::add(const std::string& name, std::string_view hash,
                     const std::filesystem::path& file) {
  const auto [known, is_new] = contents_.try_emplace(name, Content{std::string(hash), file});
  if (is_new || known->second.hash == hash) return;
  throw core::InputError(
      {.file = file.string()},
      fmt::format("contains results for different input data under the same name: {} has the "
                  "content hash {} here, but the content hash in {} is {}; copy the same files to "
                  "all machines, and measure again on the machines whose files were different",
                  name, hash, known->second.file.string(), known->second.hash));
}

std::size_t RecordCopy::Batch::bytes() const {
  std::size_t sum = records.bytes();
  for (const RowBatch& each : parts) sum += each.bytes();
  return sum;
}

void RecordCopy::Batch::clear() {
  count = 0;
  records.clear();
  for (RowBatch& each : parts) each.clear();
}

RecordCopy::RecordCopy(const std::vector<Source>& sources, const SQLite::Database& out,
                       DataHashes& data, const OnProgress& on_progress)
    : sources_(sources),
      data_(data),
      on_progress_(on_progress),
      other_columns_(other_columns(out)),
      parts_(parts_of(out)),
      record_writer_(out, "record", columns_with(other_columns_)) {
  for (const Part& part : parts_) {
    std::vector<std::string> columns{"record"};
    columns.insert(columns.end(), part.columns.begin(), part.columns.end());
    part_writers_.emplace_back(out, part.table, columns);
  }
  prepare_parts();
}

// Returns every table whose rows refer to a record, with a query that selects the rows of one
// record in the order of the table's primary key.
std::vector<RecordCopy::Part> RecordCopy::parts_of(const SQLite::Database& database) {
  std::vector<Part> parts;
  for (std::string& table :
       texts(database,
             "SELECT t.name FROM sqlite_schema t JOIN pragma_foreign_key_list(t.name) k "
             "WHERE t.type = 'table' AND k.\"table\" = 'record' ORDER BY t.name")) {
    const std::string of =
        fmt::format("FROM pragma_table_info('{}') WHERE name != 'record'", table);
    std::vector<std::string> columns = texts(database, "SELECT name " + of);
    std::vector<std::string> order =
        texts(database, "SELECT name " + of + " AND pk > 0 ORDER BY pk");
    order.insert(order.begin(), "record");
    std::string select = fmt::format("SELECT {} FROM {} WHERE record = ?1 ORDER BY {}",
                                     fmt::join(columns, ", "), table, fmt::join(order, ", "));
    parts.push_back({std::move(table), std::move(columns), std::move(select)});
  }
  return parts;
}

void RecordCopy::prepare_parts() {
  for (const Source& source : sources_) {
    auto& queries = queries_.emplace_back(parts_.size());
    on_store(source.file, [&] {
      for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::string any = fmt::format("SELECT 1 FROM {} LIMIT 1", parts_[i].table);
        if (Query(source.database, any).step())
          queries[i].emplace(source.database, parts_[i].select);
      }
    });
  }
}

// Copies the records in batches. Because reading takes as long as writing, the next batch is read
// while the previous batch is being written.
RecordCounts RecordCopy::copy(const std::vector<std::string>& runs, const std::string& run) {
  const std::string select =
      fmt::format("SELECT {}, {} FROM record WHERE run = ?1 ORDER BY configuration, device",
                  fmt::join(named_columns, ", "), fmt::join(other_columns_, ", "));
  MergedRows rows(sources_, select, 2, is_before, runs);
  RecordCounts counts;
  last_configuration_.clear();
  std::array<Batch, 2> batches;
  for (Batch& each : batches) each.parts.resize(parts_.size());
  std::future<void> writing;  // its destructor waits for the end of the task
  for (std::size_t current = 0;; current = 1 - current) {
    fill(batches[current], rows, run, counts);
    if (writing.valid()) writing.get();
    if (on_progress_) on_progress_(static_cast<std::uint64_t>(seq_));
    if (batches[current].count == 0) return counts;
    writing = std::async(std::launch::async, [this, &batch = batches[current]] { write(batch); });
  }
}

void RecordCopy::fill(Batch& batch, MergedRows& rows, const std::string& run,
                      RecordCounts& counts) {
  constexpr std::size_t most_records = 4096;
  constexpr std::size_t most_bytes = std::size_t{8} << 20;
  batch.clear();
  while (batch.count < most_records && batch.bytes() < most_bytes) {
    const MergedRows::Row* row = rows.next();
    if (row == nullptr) return;
    count(rows, *row, counts);
    const Query& record = rows.query(row->source);
    if (record.text(column::configuration) != last_configuration_ || counts.configurations == 0) {
      last_configuration_ = record.text(column::configuration);
      ++counts.configurations;
    }
    on_store(sources_[row->source].file, [&] { add(batch, record, row->source, run); });
    ++batch.count;
  }
}

void RecordCopy::add(Batch& batch, const Query& record, std::size_t source,
                     const std::string& run) {
  batch.records.add(++seq_);
  batch.records.add(std::string_view(run));
  batch.records.add(record, 0, column::seq);
  batch.records.add(record, static_cast<int>(named_columns.size()),
                    static_cast<int>(other_columns_.size()));
  std::string data = std::string(record.text(column::suite));
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!queries_[source][i]) continue;
    Query& part = *queries_[source][i];
    part.bind(1, record.integer(column::seq));
    RowBatch& rows = batch.parts[i];
    if (parts_[i].table == "factor") {
      data += add_factors(rows, part, seq_);
    } else {
      while (part.step()) {
        rows.add(seq_);
        rows.add(part, 0, static_cast<int>(parts_[i].columns.size()));
      }
    }
    part.reset();
  }
  if (const std::string_view hash = record.text(column::data_hash); !hash.empty()) {
    data_.add(data, hash, sources_[source].file);
  }
}

void RecordCopy::count(const MergedRows& rows, const MergedRows::Row& row,
                       RecordCounts& counts) const {
  const Query& taken = rows.query(row.source);
  ++counts.records[std::string(taken.text(column::device))];
  for (const std::size_t each : row.other_sources) {
    const Query& other = rows.query(each);
    if (other.text(column::seal) == taken.text(column::seal)) {
      ++counts.repeated;
    } else if (has_fault(other) && !has_fault(taken)) {
      ++counts.injected;
    } else if (rank_of(other.text(column::outcome)) > rank_of(taken.text(column::outcome))) {
      ++counts.remeasured;
    } else {
      ++counts.not_chosen;
    }
    const std::string_view hash = other.text(column::data_hash);
    if (hash.empty() || taken.text(column::data_hash).empty() ||
        hash == taken.text(column::data_hash))
      continue;
    DataHashes seen;
    const std::string name(taken.text(column::configuration));
    seen.add(name, taken.text(column::data_hash), sources_[row.source].file);
    seen.add(name, hash, sources_[each].file);
  }
}

void RecordCopy::write(const Batch& batch) {
  record_writer_.write(batch.records);
  for (std::size_t i = 0; i < parts_.size(); ++i) part_writers_[i].write(batch.parts[i]);
}

}  // namespace triptych::record
