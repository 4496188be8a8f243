#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// By how much the counters of a record may differ between two right devices, by the counters' names
// (SuiteWithTruth::open_counts). Throws core::Error if the scene is not available on this machine,
// and the record then has no open counters.
using FindOpenCounts = std::function<std::map<std::string, double>(const record::Record&)>;

// What rounding and rasterization leave open in one record's counters; computed when it is first
// needed.
class OpenCounts {
 public:
  // `find` may be empty if rounding leaves nothing open.
  OpenCounts(const record::Record& record, const FindOpenCounts& find)
      : record_(record), find_(find) {}

  [[nodiscard]] double of(const std::string& counter);

 private:
  const record::Record& record_;
  const FindOpenCounts& find_;
  std::optional<std::map<std::string, double>> known_;
};

}  // namespace triptych::judge
