#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// The allowed differences of the counters of a record between two correct devices, by the counters'
// names (SuiteWithTruth::open_counts). Throws core::Error if the scene is not available on this
// machine; the record then has no allowed differences.
using FindOpenCounts = std::function<std::map<std::string, double>(const record::Record&)>;

// The differences that rounding and rasterization allow in one record's counters, computed when
// they are first needed.
class OpenCounts {
 public:
  // `find` may be empty if rounding does not change any counter.
  OpenCounts(const record::Record& record, const FindOpenCounts& find)
      : record_(record), find_(find) {}

  [[nodiscard]] double of(const std::string& counter);

 private:
  const record::Record& record_;
  const FindOpenCounts& find_;
  std::optional<std::map<std::string, double>> known_;
};

}  // namespace triptych::judge
