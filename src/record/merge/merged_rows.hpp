#pragma once
// Reads the rows of one table from many stores as one sorted sequence.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/merge/query.hpp"

namespace triptych::record {

// A store to read from.
struct Source {
  std::filesystem::path file;
  SQLite::Database database;
};

class MergedRows {
 public:
  // Returns whether row `a` is preferred to row `b`, which has the same key. The order is total
  // except for identical rows.
  using Before = std::function<bool(const Query& a, const Query& b)>;

  // `select` must sort by its first `keys` columns, which must be of type TEXT. If `select` has a
  // parameter, `parameters` contains its value for each source. All arguments must outlive this
  // object.
  MergedRows(const std::vector<Source>& sources, std::string_view select, int keys, Before before,
             const std::vector<std::string>& parameters = {});

  // The preferred row among all rows with the same key.
  struct Row {
    std::size_t source;                      // the source that the row comes from
    std::vector<std::size_t> other_sources;  // the other sources that have a row with this key
  };
  // Advances to the next key. Returns nullptr after the last key. The returned row is valid until
  // the next call. Throws the exceptions that Store throws when it reads a file.
  [[nodiscard]] const Row* next();
  [[nodiscard]] const Query& query(std::size_t source) const { return queries_[source]; }

 private:
  [[nodiscard]] int compare(std::size_t a, std::size_t b) const;
  void advance(std::size_t source);
  [[nodiscard]] std::size_t take_first();

  const std::vector<Source>& sources_;
  std::vector<Query> queries_;
  int keys_;
  Before before_;
  std::vector<std::size_t> waiting_;  // a heap with the smallest key on top
  std::optional<Row> row_;
};

}  // namespace triptych::record
