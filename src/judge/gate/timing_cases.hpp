#pragma once
// What a run's times are judged by: each beside the medians of its stored runs.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "judge/gate/run_view.hpp"
#include "judge/timing/model.hpp"

namespace triptych::judge {

// A record that can be judged.
struct JudgedRecord {
  const record::Record* record;  // in the view
  bool other_code;               // the stored runs' last device code is not the record's
};

struct TimingCases {
  std::vector<TimingCase> cases;  // those of `judged`, in order, then the anchors' of another plan
  std::vector<JudgedRecord> judged;
  // Of each device those that its judged records have times of, in the order of time.
  std::map<std::string, std::set<std::string>> stored_runs;
  std::vector<Finding> findings;  // of every other measured record, why it is not judged
};

// Of a record that was measured and stored by several clocks the common one decides
// (common_clock, judge/baselines/baselines.hpp). The tolerance of a case is no finer than the step
// of its clock: the smallest gap between two samples of one configuration.
[[nodiscard]] TimingCases collect_timing_cases(const RunView& view, const WrongImages& wrong);

}  // namespace triptych::judge
