#pragma once
// The part of a run that becomes the baselines, and the reasons to refuse a run.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "judge/baselines/baselines.hpp"
#include "record/store.hpp"

namespace triptych::judge {

// The part of a run that is to be accepted.
struct Accepted {
  record::Run run;
  record::Checks checks;
  std::vector<record::Record> measured;
  std::vector<record::Record> skipped;  // to be dropped from the baselines
  // Skipped because the driver version lacks the feature; other versions may have it.
  std::vector<record::Record> unsupported;
  std::map<std::string, record::Device> devices;  // by id
  // The configurations and scenes for which the run has a record; used only if everything is
  // replaced.
  bool replaces_all = false;
  std::set<std::string> configurations;
  std::set<std::string> scenes;
};

// Throws InputError for a blank reason, a run of another plan, a run with injected faults, and a
// run that measured nothing.
[[nodiscard]] Accepted select_accepted(const record::Store& store, const std::string& run,
                                       const AcceptRequest& request);

// The following functions throw InputError if the run must not become the baselines.

// Refuses a run whose data have changed since. The reference image is drawn from the present data,
// so the result would be a baseline that no run can meet.
void refuse_other_data(const Accepted& accepted, const AcceptRequest& request);
// Refuses a shard, a run with --set and an interrupted run, because they would delete the rest of
// the plan from the baselines.
void refuse_part(const Accepted& accepted, const Baselines& stored, const std::string& run,
                 const AcceptRequest& request);
// Refuses an interrupted run if there are no baselines yet, because it would make baselines for
// only a part of the plan.
void refuse_incomplete(const record::Store& store, const Accepted& accepted,
                       const AcceptRequest& request);

}  // namespace triptych::judge
