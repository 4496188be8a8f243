#include "record/clock_counts.hpp"

#include <algorithm>

namespace triptych::record {

std::map<std::string, ClockCounts> clock_counts(const Store& store, const std::string& run) {
  std::map<std::string, ClockCounts> devices;
  store.visit_records(run, [&](const Record& record) {
    if (record.time_ns().empty()) return;
    ++devices[record.device][std::string(record.clock())];
  });
  return devices;
}

std::string previous_run(const Store& store, const std::string& run) {
  const std::vector<Run> runs = store.runs();
  const auto found = std::ranges::find(runs, run, &Run::id);
  if (found == runs.end()) return {};
  std::string previous;
  for (auto each = runs.begin(); each != found; ++each) {
    if (each->plan == found->plan) previous = each->id;
  }
  return previous;
}

}  // namespace triptych::record
