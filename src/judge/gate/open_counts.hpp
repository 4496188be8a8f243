#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// By how much a record's counters may differ between two right devices, by the counters' names
// (SuiteWithTruth::open_counts); throws core::Error where its scene is not here, and none are open.
using FindOpenCounts = std::function<std::map<std::string, double>(const record::Record&)>;

// What rounding and rasterization leave open of one record's counters; found once it matters.
class OpenCounts {
 public:
  // `find` may be empty: rounding leaves nothing open.
  OpenCounts(const record::Record& record, const FindOpenCounts& find)
      : record_(record), find_(find) {}

  [[nodiscard]] double of(const std::string& counter);

 private:
  const record::Record& record_;
  const FindOpenCounts& find_;
  std::optional<std::map<std::string, double>> known_;
};

}  // namespace triptych::judge
