#pragma once
// Copies the records of one plan from many stores into one, sorted by configuration and device.

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

// The content hash of each data set, and the store in which it was seen first. There is one object
// per merge.
class DataSeen {
 public:
  // Throws InputError if the name was seen with other content.
  void saw(const std::string& name, std::string_view hash, const std::filesystem::path& file);

 private:
  struct Content {
    std::string hash;
    std::filesystem::path file;
  };
  std::map<std::string, Content> contents_;
};

// The number of records that were taken, and of those that were not, by reason.
struct RecordCounts {
  std::uint64_t configurations = 0;
  std::map<std::string, std::uint64_t> records;  // by device
  // Not taken, because another record of the same configuration and device was taken:
  std::uint64_t repeated = 0;       // the same record
  std::uint64_t injected = 0;       // had an injected fault, and the other one has none
  std::uint64_t not_chosen = 0;     // differs from the other one, and its outcome is not worse
  std::uint64_t measured_anew = 0;  // failed or was skipped, and the other one did not
};

class RecordCopy {
 public:
  using Tell = std::function<void(std::uint64_t records)>;  // how many so far

  // All arguments must live as long as this object. `out` holds no records yet.
  RecordCopy(const std::vector<Source>& sources, const SQLite::Database& out, DataSeen& data,
             const Tell& tell);

  // `runs`: the run to read from each source, empty for none. `run`: the run that the records
  // become part of. Throws InputError if data have other content under the same name, and as
  // reading and writing a Store does.
  [[nodiscard]] RecordCounts copy(const std::vector<std::string>& runs, const std::string& run);

 private:
  // A table of things that belong to a record. Its first column names the record; these are the
  // others.
  struct Part {
    std::string table;
    std::vector<std::string> columns;
    std::string select;
  };
  // Records side by side, each with all its parts.
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
  DataSeen& data_;
  const Tell& tell_;
  std::vector<std::string> others_;  // columns of a record that this code need not know by name
  std::vector<Part> parts_;
  std::vector<std::vector<std::optional<Query>>> queries_;  // by source and part; empty: no rows
  RowWriter record_writer_;
  std::vector<RowWriter> part_writers_;
  std::int64_t seq_ = 0;  // number of the record that was added last
  std::string last_configuration_;
};

}  // namespace triptych::record
