#pragma once
// Selects the part of a run that becomes the baselines, and rejects runs that must not become
// baselines.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "judge/baselines/baselines.hpp"
#include "record/store.hpp"

namespace triptych::judge {

// The accepted part of a run.
struct Accepted {
  record::Run run;
  record::Checks checks;
  std::vector<record::Record> measured;
  std::vector<record::Record> skipped;  // skipped records, to be removed from the baselines
  // Records that were skipped because this driver version lacks a feature. Other driver versions
  // may support the feature.
  std::vector<record::Record> unsupported;
  std::map<std::string, record::Device> devices;  // by id
  // Whether the run replaces everything that is stored. The next two members are used only in this
  // case. They contain the configurations and scenes for which the run has a record.
  bool replaces_all = false;
  std::set<std::string> configurations;
  std::set<std::string> scenes;
};

// Selects the records to accept. Throws InputError for a blank reason, a run of another plan, a run
// with injected faults, and a run that measured nothing.
[[nodiscard]] Accepted select_accepted(const record::Store& store, const std::string& run,
                                       const AcceptRequest& request);

// The following functions throw InputError if the run must not become the baselines.

// Rejects a run whose data have changed since it was measured. The reference image is drawn from
// the current data, so the baselines would combine measurements of the old data with a reference
// image of the new data.
void refuse_other_data(const Accepted& accepted, const AcceptRequest& request);
// Rejects a shard (one of several parts of a plan), a run with --set and an interrupted run,
// because accepting such a run would delete the other configurations of the plan from the
// baselines.
void refuse_part(const Accepted& accepted, const Baselines& stored, const std::string& run,
                 const AcceptRequest& request);
// Rejects an interrupted run even if there are no baselines yet, because the baselines would cover
// only a part of the plan.
void refuse_incomplete(const record::Store& store, const Accepted& accepted,
                       const AcceptRequest& request);

}  // namespace triptych::judge
