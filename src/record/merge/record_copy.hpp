#pragma once
// Records of one plan from many stores into one, sorted by configuration and device.

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

// Which content each data set had, and where that was seen first. Stays with one merge.
class DataSeen {
 public:
  // Throws InputError where the same name had other content.
  void saw(const std::string& name, std::string_view hash, const std::filesystem::path& file);

 private:
  struct Content {
    std::string hash;
    std::filesystem::path file;
  };
  std::map<std::string, Content> contents_;
};

// What became of records.
struct RecordCounts {
  std::uint64_t configurations = 0;
  std::map<std::string, std::uint64_t> records;  // by device
  // Not taken, as there was another of the same configuration and device:
  std::uint64_t repeated = 0;       // the same record
  std::uint64_t injected = 0;       // one with an injected fault, where the one taken has none
  std::uint64_t not_chosen = 0;     // another, which did not fail where the one taken was measured
  std::uint64_t measured_anew = 0;  // one that failed or was skipped, where the one taken did not
};

class RecordCopy {
 public:
  using Tell = std::function<void(std::uint64_t records)>;  // so far

  // All must live as long. `out` holds no records yet.
  RecordCopy(const std::vector<Source>& sources, const SQLite::Database& out, DataSeen& data,
             const Tell& tell);

  // `runs`: of each source the run to read, empty for none. `run`: what they become. Throws
  // InputError for data of another content under one name, and as reading and writing a Store does.
  [[nodiscard]] RecordCounts copy(const std::vector<std::string>& runs, const std::string& run);

 private:
  // A table of what belongs to a record, by its columns behind the first, which names the record.
  struct Part {
    std::string table;
    std::vector<std::string> columns;
    std::string select;
  };
  // Records beside each other, each with all its parts.
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
  std::vector<std::string> others_;  // columns of a record that need no name here
  std::vector<Part> parts_;
  std::vector<std::vector<std::optional<Query>>> queries_;  // by source and part; none: no rows
  RowWriter record_writer_;
  std::vector<RowWriter> part_writers_;
  std::int64_t seq_ = 0;  // of the record added last
  std::string last_configuration_;
};

}  // namespace triptych::record
