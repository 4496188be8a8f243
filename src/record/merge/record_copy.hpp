#pragma once
// Copies the records of one plan from many stores into one store, sorted by configuration and
// device.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/merge/merged_rows.hpp"
#include "record/merge/row_batch.hpp"

namespace triptych::record {

// Remembers the content hash of each data set, and the store in which it was seen first. Each merge
// has one such object.
class DataHashes {
 public:
  // Throws InputError if the name was seen before with another hash.
  void add(const std::string& name, std::string_view hash, const std::filesystem::path& file);

 private:
  struct Content {
    std::string hash;
    std::filesystem::path file;
  };
  std::map<std::string, Content> contents_;
};

// The numbers of records that were copied, by device, and of records that were not copied, by
// reason.
struct RecordCounts {
  std::uint64_t configurations = 0;
  std::map<std::string, std::uint64_t> records;  // by device
  // Records that were not copied because another record of the same configuration and device was
  // copied:
  std::uint64_t repeated = 0;    // identical to the other record
  std::uint64_t injected = 0;    // has an injected fault, but the other record has none
  std::uint64_t not_chosen = 0;  // different, but with an equally good outcome
  std::uint64_t remeasured = 0;  // failed or was skipped, but the other record was measured
};

class RecordCopy {
 public:
  // Called with the number of records copied so far.
  using OnProgress = std::function<void(std::uint64_t records)>;

  // All arguments must outlive this object. `out` must not contain records yet.
  RecordCopy(const std::vector<Source>& sources, const SQLite::Database& out, DataHashes& data,
             const OnProgress& on_progress);

  // Copies the records of the runs `runs` into the run `run`. `runs` contains the id of a run for
  // each source (empty if the source has no run). Throws InputError if two data sets with the same
  // name have different content. Also throws the exceptions that Store throws when it reads and
  // writes a file.
  [[nodiscard]] RecordCounts copy(const std::vector<std::string>& runs, const std::string& run);

 private:
  // A table whose rows belong to records. Its first column refers to the record; `columns` contains
  // the names of all other columns.
  struct Part {
    std::string table;
    std::vector<std::string> columns;
    std::string select;
  };
  // A group of records, together with their rows in other tables.
  struct Batch {
    std::size_t count = 0;
    RowBatch records;
    std::vector<RowBatch> parts;
    [[nodiscard]] std::size_t bytes() const;
    void clear();
  };

  [[nodiscard]] static std::vector<Part> parts_of(const SQLite::Database& database);
  void prepare_parts();
  void fill(Batch& batch, MergedRows& rows, const std::string& run, RecordCounts& counts);
  void add(Batch& batch, const Query& record, std::size_t source, const std::string& run);
  void count(const MergedRows& rows, const MergedRows::Row& row, RecordCounts& counts) const;
  void write(const Batch& batch);

  const std::vector<Source>& sources_;
  DataHashes& data_;
  const OnProgress& on_progress_;
  std::vector<std::string>
      other_columns_;  // columns of a record that are copied without being examined
  std::vector<Part> parts_;
  std::vector<std::vector<std::optional<Query>>> queries_;  // by source and part; nullopt: no rows
  RowWriter record_writer_;
  std::vector<RowWriter> part_writers_;
  std::int64_t seq_ = 0;  // number of the most recently added record
  std::string last_configuration_;
};

}  // namespace triptych::record
