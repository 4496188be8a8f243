#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "record/record.hpp"

namespace triptych::judge {

// Returns the largest difference that two correct devices may have in each counter of a record, by
// the name of the counter (SuiteWithTruth::open_counts). Throws core::Error if the scene is not
// available on this machine; OpenCounts then allows only the differences that rasterization causes.
using FindOpenCounts = std::function<std::map<std::string, double>(const record::Record&)>;

// The differences in one record's counters that rounding and rasterization can cause. They are
// computed when they are first needed.
class OpenCounts {
 public:
  // `find` may be empty if rounding cannot change any counter.
  OpenCounts(const record::Record& record, const FindOpenCounts& find)
      : record_(record), find_(find) {}

  [[nodiscard]] double of(const std::string& counter);

 private:
  const record::Record& record_;
  const FindOpenCounts& find_;
  std::optional<std::map<std::string, double>> known_;
};

}  // namespace triptych::judge
